// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/version.h>
#include <undine/driver/run_directory.h>
#include <undine/solid/locking.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace undine
{
  namespace
  {
    namespace fs = std::filesystem;

    /// Write under a temporary name, then rename: the file is whole or not there.
    void
    write_file(const fs::path &path, const std::string &text)
    {
      const fs::path temporary = path.string() + ".part";
      std::ofstream  out(temporary);
      out << text << std::flush;
      if (!out)
        throw FileError("cannot write '" + path.string() +
                        "'. Check permissions and free space, or choose another folder with "
                        "--output.");
      out.close();
      fs::rename(temporary, path);
    }


    void
    write_parameters(const fs::path &directory, const Options &options)
    {
      std::ostringstream prm, json;
      options.write_prm(prm);
      options.write_json(json);
      write_file(directory / "parameters.prm", prm.str());
      write_file(directory / "parameters.json", json.str());
    }


    /// Run `action` on the first rank; whatever it throws is thrown on every rank.
    template <class Action>
    void
    on_first_rank(MPI_Comm communicator, const Action &action)
    {
      std::string failure;
      if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
        try
          {
            action();
          }
        catch (const std::exception &error)
          {
            failure = error.what();
          }
      failure = dealii::Utilities::MPI::broadcast(communicator, failure);
      if (!failure.empty())
        throw FileError(failure);
    }
  } // namespace


  void
  prepare_directory(const fs::path &directory,
                    const Options  &options,
                    const bool      resumed,
                    MPI_Comm        communicator)
  {
    on_first_rank(communicator, [&] {
      std::error_code problem;
      fs::create_directories(directory, problem);
      if (problem)
        throw FileError("cannot create the folder '" + directory.string() + "' for the results: " +
                        problem.message() + ". Choose another with --output or Output/Directory.");
      if (!resumed)
        {
          // What an earlier run left in the same folder must not be taken for results of this.
          for (const char *name : {"checkpoint",
                                   "statistics",
                                   "timing",
                                   "effects.json",
                                   "solution",
                                   "solution.pvd",
                                   "solution.xdmf"})
            fs::remove_all(directory / name, problem);
          write_file(directory / "original.prm", options.file().text());
        }
      write_parameters(directory, options);
    });
  }


  void
  write_whole_file(const fs::path &path, const std::string &text, MPI_Comm communicator)
  {
    on_first_rank(communicator, [&] { write_file(path, text); });
  }


  template <int dim>
  void
  print_header(Log &log, const Scene<dim> &scene, const Options &options, MPI_Comm communicator)
  {
    log.print("Undine {} ({}), deal.II {}, {} rank(s)",
              UNDINE_VERSION,
              UNDINE_BUILD_TYPE,
              DEAL_II_PACKAGE_VERSION,
              dealii::Utilities::MPI::n_mpi_processes(communicator));
    log.print("{} ({}D), from {}, results in {}",
              scene.title,
              dim,
              options.file().name(),
              scene.directory.string());
  }


  template <int dim>
  void
  print_unknowns(Log &log, const Scene<dim> &scene)
  {
    log.print("");
    if (scene.models.solid)
      log.print("bodies: {} elements, {} velocity unknowns",
                scene.models.solid->triangulation().n_global_active_cells(),
                scene.models.solid->dof_handler().n_dofs());
    if (scene.models.solid)
      for (const auto &warning : locking_warnings(*scene.models.solid))
        log.print("warning: {}", warning);
    if (scene.models.fluid)
      log.print("fluid: {} cells", scene.models.fluid->grid().n_cells());
    if (scene.models.particles)
      log.print("particles: {}", scene.models.particles->counts());
  }


  void
  write_timing(const fs::path &directory, const TimingTree &timing, Log &log, MPI_Comm communicator)
  {
    std::ostringstream table;
    timing.write(table);
    write_whole_file(directory / "timing", table.str(), communicator);
    log.print("\n{}", table.str());
  }


  template void
  print_header(Log &, const Scene<2> &, const Options &, MPI_Comm);
  template void
  print_header(Log &, const Scene<3> &, const Options &, MPI_Comm);
  template void
  print_unknowns(Log &, const Scene<2> &);
  template void
  print_unknowns(Log &, const Scene<3> &);
} // namespace undine
