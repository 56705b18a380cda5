// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/driver/other_program.h>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <system_error>

extern char **environ; // of POSIX, declared by no header

namespace undine
{
  namespace
  {
    using Clockwork = std::chrono::steady_clock;


    std::vector<char *>
    pointers(const std::vector<std::string> &words)
    {
      std::vector<char *> result;
      for (const auto &word : words)
        result.push_back(const_cast<char *>(word.c_str()));
      result.push_back(nullptr);
      return result;
    }


    /// The environment of this program, in which some variables are replaced or added.
    std::vector<std::string>
    environment_with(const std::vector<std::string> &changes)
    {
      std::vector<std::string> result = changes;
      for (char **variable = environ; *variable != nullptr; ++variable)
        {
          const std::string text = *variable;
          const std::string name = text.substr(0, text.find('=') + 1);
          bool              kept = true;
          for (const auto &change : changes)
            kept = kept && change.compare(0, name.size(), name) != 0;
          if (kept)
            result.push_back(text);
        }
      return result;
    }


    std::string
    reason_of(const int code)
    {
      return std::generic_category().message(code);
    }


    /// Start the program in a process group of its own, with errors going into the pipe. Returns
    /// the number of its process, or minus the number of the error.
    pid_t
    start_process(const std::vector<std::string> &words,
                  const std::vector<std::string> &environment,
                  const std::array<int, 2>       &pipe)
    {
      posix_spawn_file_actions_t files;
      posix_spawnattr_t          attributes;
      posix_spawn_file_actions_init(&files);
      posix_spawnattr_init(&attributes);
      posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
      posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
      posix_spawn_file_actions_adddup2(&files, pipe[1], STDERR_FILENO);
      posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
      posix_spawnattr_setpgroup(&attributes, 0);
      const auto all     = environment_with(environment);
      pid_t      process = 0;
      const int  code    = ::posix_spawnp(&process,
                                      words.front().c_str(),
                                      &files,
                                      &attributes,
                                      pointers(words).data(),
                                      pointers(all).data());
      posix_spawn_file_actions_destroy(&files);
      posix_spawnattr_destroy(&attributes);
      return code == 0 ? process : -code;
    }


    /// What comes out of a pipe until it is closed, or until then.
    std::string
    read_until(const int pipe, const Clockwork::time_point end, bool &is_late)
    {
      std::string            text;
      std::array<char, 4096> part{};
      while (true)
        {
          const auto left =
            std::chrono::duration_cast<std::chrono::milliseconds>(end - Clockwork::now()).count();
          pollfd    waiting{pipe, POLLIN, 0};
          const int ready = left > 0 ? ::poll(&waiting, 1, static_cast<int>(left)) : 0;
          if (ready == 0)
            {
              is_late = true;
              return text;
            }
          if (ready < 0 && errno == EINTR)
            continue;
          const auto n = ::read(pipe, part.data(), part.size());
          if (n < 0 && errno == EINTR)
            continue;
          if (n <= 0)
            return text;
          text.append(part.data(), n);
        }
    }


    std::string
    last_line(std::string text)
    {
      const auto end = text.find_last_not_of(" \n");
      text.erase(end == std::string::npos ? 0 : end + 1);
      const auto begin = text.rfind('\n');
      return begin == std::string::npos ? text : text.substr(begin + 1);
    }
  } // namespace


  std::string
  call_program(const std::vector<std::string> &words,
               const std::vector<std::string> &environment,
               const std::chrono::milliseconds limit)
  {
    std::array<int, 2> pipe{};
    if (::pipe2(pipe.data(), O_CLOEXEC) != 0)
      return reason_of(errno);
    const pid_t process = start_process(words, environment, pipe);
    ::close(pipe[1]);
    if (process < 0)
      {
        ::close(pipe[0]);
        return "'" + words.front() + "' cannot be started: " + reason_of(-process);
      }
    bool       is_late = false;
    const auto said    = read_until(pipe[0], Clockwork::now() + limit, is_late);
    ::close(pipe[0]);
    if (is_late)
      ::kill(-process, SIGKILL);
    int status = 0;
    while (::waitpid(process, &status, 0) < 0)
      if (errno != EINTR)
        return reason_of(errno);
    if (is_late)
      return "it takes longer than " + std::to_string(limit.count() / 1000) + " s";
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
      return "";
    const auto line = last_line(said);
    return line.empty() ? "'" + words.front() + "' has failed without a message" : line;
  }
} // namespace undine
