// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_scene_scene_h
#define undine_scene_scene_h

#include <undine/base/options/options.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/scheme/scheme.h>
#include <undine/output/output.h>
#include <undine/output/probes/probe.h>

#include <deal.II/base/mpi.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace undine
{
  /// All that a parameter file describes, ready to run.
  template <int dim>
  struct Scene
  {
    std::string                               title;
    std::filesystem::path                     directory;         ///< where results go
    bool                                      has_report = true; ///< a page about the run
    Clock                                     clock;
    Models<dim>                               models;
    std::unique_ptr<Scheme<dim>>              scheme;
    std::vector<std::unique_ptr<Output<dim>>> outputs;
    std::vector<std::unique_ptr<Probe<dim>>>  probes;
  };

  /// The dimension that the scene asks for. Throws InputError unless it is 2 or 3.
  unsigned int
  read_dimension(const Options &options);

  /// Read every section for its mistakes; nothing that takes time or memory is built. Returns notes
  /// about what is not read. Throws InputError with all mistakes (Options::collecting()), or the
  /// first.
  template <int dim>
  std::vector<std::string>
  check_sections(const Options &options);

  /// Read and check the whole parameter file and build the models. Collective. Throws InputError.
  template <int dim>
  Scene<dim>
  read_scene(const Options &options, MPI_Comm communicator);

  /// Declare every parameter of every part, for --reference (`options` is
  /// Options::for_reference()).
  template <int dim>
  void
  declare_scene(const Options &options);
} // namespace undine

#endif
