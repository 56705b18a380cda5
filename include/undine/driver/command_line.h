// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_driver_command_line_h
#define undine_driver_command_line_h

#include <mpi.h>

#include <string>
#include <vector>

namespace undine
{
  /// What the user asks of the program.
  struct Request
  {
    /// What the program is to do.
    enum class Action
    {
      run,        ///< run `scene_file`
      resume,     ///< continue the run in `directory`
      validate,   ///< read and check `scene_file`, run nothing
      reference,  ///< print all parameters
      parameters, ///< read the sections of `scene_file` and print its parameters as JSON
      study,      ///< read the study in `scene_file` and print it as JSON
      evaluate,   ///< evaluate `expression` at the places and times of the standard input
      nothing     ///< help or version was printed
    };

    Action                   action = Action::nothing;
    std::string              scene_file;
    std::string              directory;         ///< of the run to resume
    std::string              expression;        ///< to evaluate
    std::string              section;           ///< of --reference; empty: all
    std::string              output;            ///< --output; empty: not given
    std::vector<std::string> assignments;       ///< of --set
    bool                     overwrite = false; ///< an unfinished run in the folder for results
    int                      exit_code = 0;
  };

  /// Reads the program's arguments. The first rank prints help and errors.
  Request
  read_command_line(int argc, char **argv, MPI_Comm communicator);
} // namespace undine

#endif
