// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/version.h>
#include <undine/base/options/options_output.h>
#include <undine/driver/run_directory.h>
#include <undine/output/files/files.h>
#include <undine/solid/mesh/locking.h>

#include <fmt/format.h>

#include <sstream>

namespace undine
{
  namespace
  {
    namespace fs = std::filesystem;


    /// What is copied if a run goes on in another folder: the text of a file, empty without one.
    std::string
    text_of(const fs::path &file)
    {
      return fs::exists(file) ? read_file(file) : "";
    }
  } // namespace


  void
  assert_replaceable(const ResultFolder &folder,
                     const Request      &request,
                     const MPI_Comm      communicator)
  {
    folder.assert_nothing_foreign();
    if (request.overwrite || folder.is_finished())
      return;
    on_first_rank(communicator, [&] {
      const auto step = resumable_step(folder.path());
      if (step > 0)
        throw FileError(fmt::format("the folder '{0}' holds a run that has not reached its end. It "
                                    "can go on from step {1}: 'undine resume {0}'. To begin anew, "
                                    "choose another folder with --output, or replace that run with "
                                    "--overwrite.",
                                    folder.path().string(),
                                    step));
    });
  }


  void
  prepare_directory(ResultFolder                     &folder,
                    const Options                    &options,
                    const std::optional<ResumedFrom> &from,
                    const MPI_Comm                    communicator)
  {
    const bool  goes_on  = from && from->directory == folder.path();
    std::string original = options.file().text(), statistics;
    if (goes_on)
      folder.go_on();
    else
      folder.begin();
    if (from && !goes_on)
      on_first_rank(communicator, [&] {
        original   = text_of(from->directory / "original.prm");
        statistics = text_of(from->directory / "statistics");
      });
    if (!goes_on)
      write_whole_file(folder, "original.prm", original, communicator);
    if (from && !goes_on)
      write_whole_file(folder, "statistics", statistics, communicator);
    std::ostringstream prm, json;
    write_prm(prm, options);
    write_json(json, options);
    write_whole_file(folder, "parameters.prm", prm.str(), communicator);
    write_whole_file(folder, "parameters.json", json.str(), communicator);
    folder.claim("log.txt");
    for (const auto &file : checkpoint_files())
      folder.claim(file);
  }


  void
  write_whole_file(ResultFolder      &folder,
                   const std::string &name,
                   const std::string &text,
                   const MPI_Comm     communicator)
  {
    folder.claim(name);
    on_first_rank(communicator, [&] { write_file(folder.path() / name, text); });
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


  std::string
  timing_table(const TimingTree &timing)
  {
    std::ostringstream table;
    timing.write(table);
    return table.str();
  }


  void
  write_timing(ResultFolder     &folder,
               const TimingTree &timing,
               Log              &log,
               const MPI_Comm    communicator)
  {
    write_whole_file(folder, "timing", timing_table(timing), communicator);
    log.print("\n{}", timing_table(timing));
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
