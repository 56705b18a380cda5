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
    const TimeRecords::Frame xdmf_frame{
      "<?xml version=\"1.0\" ?>\n<!DOCTYPE Xdmf SYSTEM \"Xdmf.dtd\" []>\n<Xdmf Version=\"2.0\">\n"
      "<Domain>\n<Grid Name=\"solution\" GridType=\"Collection\" CollectionType=\"Temporal\">\n",
      "</Grid>\n</Domain>\n</Xdmf>\n"};


    /// A part's description, by its name instead of deal.II's "mesh".
    std::string
    named(std::string description, const std::string &name)
    {
      const std::string unnamed = "Name=\"mesh\"";
      const auto        place   = description.find(unnamed);
      if (place != std::string::npos)
        description.replace(place, unnamed.size(), "Name=\"" + name + "\"");
      return description;
    }


    /// One time: bodies and fluid side by side.
    std::string
    at_time(const double time, const std::string &parts)
    {
      return fmt::format(
        "<Grid Name=\"parts\" GridType=\"Collection\" CollectionType=\"Spatial\">\n"
        "<Time Value=\"{:.12g}\"/>\n{}</Grid>\n",
        time,
        parts);
    }
  } // namespace


  /// The solution as HDF5 arrays, for own evaluations and, by way of `solution.xdmf`, for ParaView:
  /// one file of the bodies and one of the fluid, or one of the particles, for every output time.
  template <int dim>
  class Xdmf : public Output<dim>
  {
  public:
    void
    add_options(const Options &) override
    {
    }

    void
    start(const OutputContext<dim> &new_context, const State<dim> &state) override
    {
      context = std::make_unique<const OutputContext<dim>>(new_context);
      on_first_rank(context->communicator,
                    [&] { make_folder(context->folder.path() / "solution"); });
      context->folder.claim("solution.xdmf");
      records = std::make_unique<TimeRecords>(
        context->communicator, context->folder.path() / "solution.xdmf", xdmf_frame, state.clock);
    }

    bool
    due(const Clock &clock) const override
    {
      return is_output_time(clock);
    }

    void
    write(const State<dim> &state, const Report &) override
    {
      const auto  timed = context->timing.section("xdmf");
      std::string grids;
      for (const auto &part : solution_parts(context->models, state))
        grids += write_part(part, state.clock);
      if (context->models.particles)
        grids +=
          write_part(particle_patches(*context->models.particles, state.particles), state.clock);
      records->add(state.clock.time, at_time(state.clock.time, grids));
    }

  private:
    /// Returns its description for `solution.xdmf`.
    template <int n, int spacedim>
    std::string
    write_part(const Patches<n, spacedim> &part, const Clock &clock) const
    {
      const auto file = solution_file(part.name, clock, "h5");
      context->folder.claim(file);
      const auto entry = write_hdf5(
        context->communicator, context->folder.path() / file, file.string(), part, clock.time);
      return named(entry.get_xdmf_content(1, dealii::ReferenceCells::get_hypercube<n>()),
                   part.name);
    }

    std::unique_ptr<const OutputContext<dim>> context;
    std::unique_ptr<TimeRecords>              records;
  };


  namespace
  {
    const RegisterForDimensions<Output, Xdmf>
      xdmf("xdmf", "HDF5 arrays for own evaluations, with solution.xdmf for ParaView");
  }
} // namespace undine
