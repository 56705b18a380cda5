// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/probes/particle_queries.h>
#include <undine/output/probes/probe.h>

#include <algorithm>
#include <limits>

namespace undine
{
  /// How far a fluid of particles has come along an axis [m]: the outer end of the cube of the
  /// farthest particle of its largest part, without drops that have come off; without any fluid,
  /// where the domain begins.
  template <int dim>
  class Front : public Probe<dim>
  {
  public:
    void
    add_options(const Options &options) override
    {
      std::vector<std::string> words;
      for (unsigned int axis = 0; axis < dim; ++axis)
        for (const char *sign : {"", "-"})
          words.push_back(std::string(sign) + "xyz"[axis]);
      options.add("Direction",
                  direction,
                  "",
                  Allowed::one_of(words),
                  "In which the fluid advances; its largest coordinate along x, or with '-x' its "
                  "smallest one.");
      options.add("Gap",
                  gap,
                  "spacings",
                  Allowed::between(1, 10),
                  "Particles that are farther apart than this do not belong together.");
    }

    void
    start(const std::string &probe_name, const Options &options, const Models<dim> &models) override
    {
      name = probe_name;
      if (!models.particles || !models.particles->has_fluid())
        throw options.error("Kind",
                            "the scene has no fluid of particles",
                            "Try: remove the probe, or 'Scheme = particle' and a section 'Fluid'.");
    }

    Columns
    columns(const Models<dim> &models, const State<dim> &state) const override
    {
      const int          sign    = direction.front() == '-' ? -1 : 1;
      const unsigned int axis    = direction.back() - 'x';
      const auto        &box     = models.particles->domain();
      const double       spacing = box.spacing;
      const auto         part    = main_part_of_fluid(box, state.particles, gap * spacing);
      if (part.empty()) // it has yet to begin
        return {{name, "m", sign > 0 ? box.lower[axis] : box.upper[axis]}};
      double front = -std::numeric_limits<double>::infinity();
      for (const auto k : part)
        front = std::max(front, sign * state.particles.positions[k][axis]);
      return {{name, "m", sign * (front + spacing / 2)}};
    }

  private:
    std::string name;
    std::string direction = "x";
    double      gap       = 1.5; ///< [spacings]
  };


  namespace
  {
    const RegisterForDimensions<Probe, Front>
      front("front", "how far a fluid of particles has come along an axis");
  }
} // namespace undine
