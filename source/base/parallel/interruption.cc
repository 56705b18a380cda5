// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/interruption.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <unistd.h>

namespace undine
{
  namespace
  {
    // A handler of signals can tell the program nothing but by objects of this kind.
    std::atomic<int>  asked{0};    // the number of the signal; 0: none
    std::atomic<long> asked_at{0}; // [ms]
    std::atomic<bool> is_rank{false};


    long
    milliseconds()
    {
      timespec now = {};
      clock_gettime(CLOCK_MONOTONIC, &now);
      return now.tv_sec * 1000 + now.tv_nsec / 1000000;
    }


    // Several signals within this time are one request.
    constexpr long pause = 1000; // [ms]


    /// Open MPI's mpirun, the parent of its ranks, follows every signal that a batch system sends
    /// to all processes by a SIGTERM of its own, a while later: the same request.
    bool
    is_echo_of_launcher(const int number, const siginfo_t *info)
    {
      return is_rank && number == SIGTERM && info->si_pid == getppid();
    }


    extern "C" void
    note_signal(const int number, siginfo_t *info, void *)
    {
      const int saved_errno = errno;
      if (asked == 0)
        {
          asked_at = milliseconds();
          asked    = number;
        }
      else if (milliseconds() > asked_at + pause && !is_echo_of_launcher(number, info))
        {
          std::signal(number, SIG_DFL);
          std::raise(number);
        }
      errno = saved_errno;
    }
  } // namespace


  void
  listen_for_interruption()
  {
    is_rank                 = std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr;
    struct sigaction action = {};
    action.sa_sigaction     = note_signal;
    action.sa_flags         = SA_RESTART | SA_SIGINFO; // reading and writing go on
    sigemptyset(&action.sa_mask);
    for (const int number : {SIGINT, SIGTERM, SIGUSR1})
      sigaction(number, &action, nullptr);
  }


  bool
  interruption_requested()
  {
    return asked != 0;
  }


  std::string
  interruption_name()
  {
    switch (asked)
      {
        case 0:
          return "";
        case SIGINT:
          return "SIGINT";
        case SIGTERM:
          return "SIGTERM";
        default:
          return "SIGUSR1";
      }
  }


  void
  throw_if_interrupted(const MPI_Comm communicator)
  {
    namespace MPI              = dealii::Utilities::MPI;
    const unsigned int n_ranks = MPI::n_mpi_processes(communicator);
    const unsigned int rank    = MPI::this_mpi_process(communicator);
    const unsigned int first   = MPI::min(interruption_requested() ? rank : n_ranks, communicator);
    if (first < n_ranks)
      throw Interruption("stopped by " + MPI::broadcast(communicator, interruption_name(), first));
  }
} // namespace undine
