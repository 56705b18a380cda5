// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/fields/particle_patches.h>
#include <undine/output/fields/solution_parts.h>
#include <undine/output/files/files.h>
#include <undine/output/files/schedule.h>
#include <undine/output/files/time_records.h>
#include <undine/output/output.h>

#include <fmt/format.h>

namespace undine
{
  namespace
  {
    const TimeRecords::Frame pvd_frame{
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n<Collection>\n",
      "</Collection>\n</VTKFile>\n"};
  } // namespace


  /// Pictures for ParaView: `solution.pvd` lists, for every output time, one compressed .vtu file
  /// for each part: bodies, fluid, and the surfaces in the fluid; or particles.
  template <int dim>
  class Vtu : public Output<dim>
  {
  public:
    void
    add_options(const Options &output) override
    {
      const auto options = output.section("vtu");
      options.add("Bodies",
                  bodies,
                  "",
                  Allowed::one_of({"rest", "deformed"}),
                  "Where bodies are drawn: at rest, for ParaView's filter Warp By Vector with "
                  "'displacement', or where they are.");
      options.add("Cells of bodies",
                  cells,
                  "",
                  Allowed::one_of({"linear", "high-order"}),
                  "Quadratic elements as several linear cells, which every program reads, or as "
                  "one Lagrange cell.");
    }

    void
    start(const OutputContext<dim> &new_context, const State<dim> &state) override
    {
      context = std::make_unique<const OutputContext<dim>>(new_context);
      on_first_rank(context->communicator,
                    [&] { make_folder(context->folder.path() / "solution"); });
      context->folder.claim("solution.pvd");
      records = std::make_unique<TimeRecords>(
        context->communicator, context->folder.path() / "solution.pvd", pvd_frame, state.clock);
    }

    bool
    due(const Clock &clock) const override
    {
      return is_output_time(clock);
    }

    void
    write(const State<dim> &state, const Report &) override
    {
      const auto timed = context->timing.section("vtu");
      lines.clear();
      n_parts = 0;
      for (const auto &part :
           solution_parts(context->models,
                          state,
                          bodies == "rest" ? Configuration::rest : Configuration::deformed))
        add(part, state.clock);
      for (const auto &part : surface_parts(context->models, state))
        add(part, state.clock);
      if (context->models.particles)
        add(particle_patches(*context->models.particles, state.particles), state.clock);
      records->add(state.clock.time, lines);
    }

  private:
    /// Write a part and note it in `lines`.
    template <int n, int spacedim>
    void
    add(const Patches<n, spacedim> &part, const Clock &clock)
    {
      const auto file = solution_file(part.name, clock, "vtu");
      context->folder.claim(file);
      write_vtu(context->communicator, context->folder.path() / file, part, flags(part, clock));
      lines += fmt::format(
        "<DataSet timestep=\"{:.12g}\" group=\"\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n",
        clock.time,
        n_parts++,
        part.name,
        file.string());
    }

    template <int n, int spacedim>
    dealii::DataOutBase::VtkFlags
    flags(const Patches<n, spacedim> &part, const Clock &clock) const
    {
      dealii::DataOutBase::VtkFlags result(clock.time, clock.step);
      result.print_date_and_time      = false;
      result.compression_level        = decltype(result.compression_level)::best_speed;
      result.write_higher_order_cells = part.name == "bodies" && cells == "high-order";
      result.physical_units           = part.units;
      return result;
    }

    std::string                               bodies = "rest";
    std::string                               cells  = "linear";
    std::unique_ptr<const OutputContext<dim>> context;
    std::unique_ptr<TimeRecords>              records;
    std::string                               lines; ///< of solution.pvd, for one time
    unsigned int                              n_parts = 0;
  };


  namespace
  {
    const RegisterForDimensions<Output, Vtu>
      vtu("vtu", "pictures for ParaView: solution.pvd and compressed .vtu files");
  }
} // namespace undine
