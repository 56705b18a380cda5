// SPDX-License-Identifier: LGPL-2.1-or-later
// To be preloaded into the program that the mutating tester starts very often (process.py). Half of the time of
// a short start goes into finding the symbols of some 200 libraries. This stops the program when that is done,
// before main(), and continues a copy of the process for each request from a socket. What a copy does from
// there on is what a program does that has been started with these arguments.
//
// A request is a line for each of: folder, file for what is printed, file for errors, folder for Open MPI's
// files, number of arguments; then the arguments, each ending in a zero byte. The answers are two numbers in lines
// of their own: the process, and how it ended (waitpid).
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static void
fail(const char *what)
{
  dprintf(2, "fork_server: %s: %s\n", what, strerror(errno));
  _exit(125);
}


static char *
read_word(FILE *requests, const int end)
{
  char  *word = NULL;
  size_t size = 0;
  ssize_t length = getdelim(&word, &size, end, requests);
  if (length <= 0)
    return NULL;
  if (word[length - 1] == end)
    word[length - 1] = 0;
  return word;
}


static void
redirect(const char *path, const int to)
{
  const int file = open(path, O_RDWR | O_CREAT | O_APPEND, 0600);
  if (file < 0 || dup2(file, to) < 0)
    fail(path);
  close(file);
}


// Become a program that has been started in `folder` with the arguments of the request.
static void
continue_as(FILE *requests, char **words, const int n_arguments, char **arguments, char **argv)
{
  const int connection = fileno(requests);
  setsid();
  if (chdir(words[0]) != 0)
    fail(words[0]);
  redirect("/dev/null", 0);
  redirect(words[1], 1);
  redirect(words[2], 2);
  setenv("OMPI_MCA_orte_tmpdir_base", words[3], 1);
  unsetenv("LD_PRELOAD");
  unsetenv("UNDINE_FORK_SERVER");
  close(connection);
  for (int i = 0; i < n_arguments; ++i)
    argv[i + 1] = arguments[i];
  argv[n_arguments + 1] = NULL;
  ((long *) argv)[-1]   = n_arguments + 1; // where _start finds argc
}


__attribute__((constructor)) static void
serve(const int argc, char **argv)
{
  const char *descriptor = getenv("UNDINE_FORK_SERVER");
  if (descriptor == NULL)
    return;
  FILE *requests = fdopen(atoi(descriptor), "r");
  if (requests == NULL)
    fail("no socket");
  for (;;)
    {
      char *words[5];
      for (int i = 0; i < 5; ++i)
        if ((words[i] = read_word(requests, '\n')) == NULL)
          _exit(0); // the tester has ended
      const int n_arguments = atoi(words[4]);
      if (n_arguments + 1 > argc)
        fail("too many arguments");
      char *arguments[n_arguments + 1];
      for (int i = 0; i < n_arguments; ++i)
        if ((arguments[i] = read_word(requests, 0)) == NULL)
          _exit(0);
      const pid_t child = fork();
      if (child < 0)
        fail("fork");
      if (child == 0)
        {
          continue_as(requests, words, n_arguments, arguments, argv);
          return;
        }
      dprintf(fileno(requests), "%d\n", child);
      int status = 0;
      while (waitpid(child, &status, 0) < 0)
        if (errno != EINTR)
          fail("waitpid");
      dprintf(fileno(requests), "%d\n", status);
      for (int i = 0; i < 5; ++i)
        free(words[i]);
      for (int i = 0; i < n_arguments; ++i)
        free(arguments[i]);
    }
}
