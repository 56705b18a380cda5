// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/version.h>
#include <undine/driver/command_line.h>

#include <deal.II/base/config.h>
#include <deal.II/base/mpi.h>

#include <CLI/CLI.hpp>

#include <iostream>
#include <sstream>

namespace undine
{
  namespace
  {
    void
    add_assignments(CLI::App &command, Request &request)
    {
      command
        .add_option("--set",
                    request.assignments,
                    "change a parameter: --set \"Time/End=2\" (may be given several times)")
        ->type_name("Section/Key=value")
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }


    /// Where results go, and with which settings: for new runs and for those that are taken up
    /// again.
    void
    add_run_options(CLI::App &command, Request &request, const std::string &output)
    {
      command.add_option("--output", request.output, output)
        ->type_name("DIR")
        ->check(CLI::Validator(
          [](const std::string &folder) {
            return folder.rfind("--", 0) == 0
                     ? "'" + folder + "' is an option, no folder: what shall the folder be?"
                     : std::string();
          },
          ""));
      command.add_flag("--overwrite",
                       request.overwrite,
                       "replace a run in that folder which has not reached its end");
      add_assignments(command, request);
    }


    /// Subcommands that make no run, for scripts.
    struct Answers
    {
      const CLI::App *study, *parameters, *evaluate;
    };


    Answers
    add_answers(CLI::App &app, Request &request)
    {
      CLI::App *study = app.add_subcommand(
        "read-study", "check a study and print it as JSON, which './undine study' reads");
      study->add_option("study", request.scene_file, "its parameter file")
        ->required()
        ->type_name("STUDY.prm");
      CLI::App *parameters = app.add_subcommand(
        "read-scene", "check the sections of a scene and print all parameters as JSON");
      parameters->add_option("scene", request.scene_file, "its parameter file")
        ->required()
        ->type_name("SCENE.prm");
      add_assignments(*parameters, request);
      CLI::App *evaluate = app.add_subcommand(
        "evaluate", "evaluate an expression at each line 'x y z t' of the standard input");
      evaluate
        ->add_option(
          "expression", request.expression, "in x, y, z, t; after -- if it begins with a minus")
        ->required();
      return {study, parameters, evaluate};
    }
  } // namespace


  Request
  read_command_line(const int argc, char **argv, const MPI_Comm communicator)
  {
    Request  request;
    CLI::App app(
      "Undine: two-way coupling of incompressible fluids and deformable bodies.\n"
      "Results go to the folder named by Output/Directory in the scene, or by --output.\n"
      "In parallel: mpirun -n 4 undine SCENE.prm",
      "undine");
    app.set_version_flag("--version",
                         std::string("undine " UNDINE_VERSION " (deal.II " DEAL_II_PACKAGE_VERSION
                                     ", " UNDINE_BUILD_TYPE ")"));
    bool validate = false;
    app.add_option("scene", request.scene_file, "the parameter file to run")
      ->type_name("SCENE.prm");
    add_run_options(app, request, "folder for the results");
    app.add_flag("--validate", validate, "check the scene, run nothing");
    const auto *reference =
      app
        .add_option("--reference",
                    request.section,
                    "print every parameter with unit, range and default, or those of a section: "
                    "--reference \"Output/vtu\"")
        ->type_name("[SECTION]")
        ->expected(0, 1);

    CLI::App *resume = app.add_subcommand("resume", "continue a run from its last checkpoint");
    resume->add_option("directory", request.directory, "folder of the run")
      ->required()
      ->type_name("DIR");
    add_run_options(*resume, request, "folder for what follows, which leaves the run as it is");

    const auto answers = add_answers(app, request);

    std::ostringstream out, err;
    try
      {
        app.parse(argc, argv);
        if (app.get_subcommands().empty() && reference->count() == 0 && request.scene_file.empty())
          throw CLI::ValidationError(
            "no scene", "name a parameter file, for example prm/cantilever.prm; see --help");
      }
    catch (const CLI::ParseError &stop)
      {
        request.exit_code = app.exit(stop, out, err) == 0 ? 0 : 2;
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          {
            std::cout << out.str();
            std::cerr << err.str();
          }
        return request;
      }

    request.action = resume->parsed()               ? Request::Action::resume
                     : answers.study->parsed()      ? Request::Action::study
                     : answers.parameters->parsed() ? Request::Action::parameters
                     : answers.evaluate->parsed()   ? Request::Action::evaluate
                     : reference->count() > 0       ? Request::Action::reference
                     : validate                     ? Request::Action::validate
                                                    : Request::Action::run;
    return request;
  }
} // namespace undine
