// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_advection_advection_h
#define undine_fluid_advection_advection_h

#include <undine/fluid/advection/characteristic_tracer.h>
#include <undine/fluid/advection/uniform_regions.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace undine
{
  /// How fields that are advected from t on have changed by themselves before.
  template <int dim>
  struct GoingOn
  {
    /// Each has gone on from t to that time [s], which is that of what walls prescribe. What enters
    /// the domain has gone on for as long as it has been inside. Empty: what enters is what is on
    /// the boundary at t.
    std::vector<double> times = {};
    /// With that rate, on the topology of the fields; nullptr: none.
    const Field<dim> *rate = nullptr;
  };


  /// A method by which the flow advects a field for one step: ds/dt + v.grad s = 0. The same code
  /// serves scalars in cells and velocities on faces.
  template <int dim>
  class Advection
  {
  public:
    virtual ~Advection() = default;

    /// Declare and read the keys of this method.
    virtual void
    add_options(const Options &options) = 0;

    /// In a few words: "MacCormack, limited".
    virtual std::string
    summary() const = 0;

    /// Fields at t + h from fields at t, on the present topology of the fluid. All of them have the
    /// same lattice, topology and ghost layers and the same boundary condition, so that every path
    /// is traced once. Collective.
    virtual std::vector<Field<dim>>
    advect(const CharacteristicTracer<dim> &tracer,
           std::vector<Field<dim>>          fields,
           const GoingOn<dim>              &going_on,
           const BoundaryCondition<dim>    &condition) const = 0;

    /// The same of one field.
    Field<dim>
    advect(const CharacteristicTracer<dim> &tracer,
           const Field<dim>                &field,
           const BoundaryCondition<dim>    &condition) const
    {
      return std::move(
        advect(tracer, std::vector<Field<dim>>(1, field), {{tracer.time()}}, condition).front());
    }
  };

  /// `fields` with the ghost layers that `tracer` needs and with boundary points as `condition`
  /// and `extension` say. Collective.
  template <int dim>
  std::vector<Field<dim>>
  completed(const CharacteristicTracer<dim> &tracer,
            std::vector<Field<dim>>          fields,
            const GoingOn<dim>              &going_on,
            const BoundaryCondition<dim>    &condition,
            Extension                        extension = Extension::constant);

  /// The same of one field, at `time` [s].
  template <int dim>
  Field<dim>
  completed(const CharacteristicTracer<dim> &tracer,
            Field<dim>                       field,
            const double                     time,
            const BoundaryCondition<dim>    &condition);

  /// What enters the domain where a path has left it, at `time` [s]; nothing if that is what is
  /// there.
  template <int dim>
  std::optional<double>
  entering_value(const CharacteristicTracer<dim>                 &tracer,
                 const typename CharacteristicTracer<dim>::Trace &trace,
                 const Field<dim>                                &field,
                 const BoundaryCondition<dim>                    &condition,
                 const double                                     time);

  /// The values that fluid brings to a point that has entered during the step: those of the time
  /// when it did, gone on as fields of advect() since. Nothing if it has not, or that is not known.
  template <int dim>
  std::vector<double>
  values_since_entry(const CharacteristicTracer<dim>                 &tracer,
                     const typename CharacteristicTracer<dim>::Trace &trace,
                     const std::vector<Field<dim>>                   &sources,
                     const GoingOn<dim>                              &going_on,
                     const BoundaryCondition<dim>                    &condition,
                     const GridIndex<dim>                            &index);

  /// The values at the feet of paths that come near a body, from visible samples.
  template <int dim>
  class NearBodies
  {
  public:
    using Place = typename BodyVicinity<dim>::Place;

    /// `source` is what completed() returned. The references must outlive it. Collective.
    NearBodies(const CharacteristicTracer<dim> &tracer, const Field<dim> &source);

    /// The value that the path from `foot` brings to `part`, a sub-cell or sub-face or, by whole(),
    /// a whole point. Where no sample is visible, a velocity is that of the nearest surface, next
    /// to a deformable body no larger than those of the fluid that was there; a scalar is NaN.
    double
    value_at(const typename SubLattice<dim>::Part &part, const Place &foot) const;

    /// A whole point as a part of itself.
    typename SubLattice<dim>::Part
    whole(const GridIndex<dim> &index) const;

    /// The value before the last motion of bodies of what has certainly been the same sub-cell or
    /// sub-face as `part`: both are the only ones of their point, and together they are larger than
    /// the point, so that they overlap. Whether surfaces hide the centroid of one from that of the
    /// other does not matter then: a centroid may lie in a body. Nothing if both are whole or a
    /// surface has passed over both centroids, since a thin body may have passed between.
    std::optional<double>
    value_before(const typename SubLattice<dim>::Part &part) const;

    /// The mean of what is visible from a sub-face among the faces next to it in its plane and
    /// across it, by their open areas; nothing if nothing is.
    std::optional<double>
    mean_around(const typename SubLattice<dim>::Part &part) const;

    /// Cells and components to which nothing was brought are filled, see fill_unknown(); divided
    /// points take the mean of their sub-cells or sub-faces. Collective.
    void
    finish(Field<dim> &advected, const BoundaryCondition<dim> &condition) const;

  private:
    double
    measure_of_point(const GridIndex<dim> &index) const;
    double
    largest_around(const GridIndex<dim> &index) const;

    const CharacteristicTracer<dim>           &tracer;
    const Field<dim>                          &source;
    const Lattice<dim>                        &lattice;
    unsigned int                               axis; ///< of a velocity; no_axis: scalar
    std::unique_ptr<const VisibleSamples<dim>> samples;
  };

  /// Fields at t + h on the present topology of the fluid. `far(trace, index)`, for a path that
  /// stays away from bodies, is a function of k, the value of field k; near them all methods are
  /// alike, see NearBodies; uniform regions keep their values. `sources` are what completed()
  /// returned with the same condition; `far` takes no points further than `reach` away. Collective.
  template <int dim, class Far>
  std::vector<Field<dim>>
  advect_along_paths(const CharacteristicTracer<dim> &tracer,
                     const std::vector<Field<dim>>   &sources,
                     const GoingOn<dim>              &going_on,
                     const BoundaryCondition<dim>    &condition,
                     const GridIndex<dim>            &reach,
                     Far                            &&far)
  {
    for (const auto &source : sources)
      AssertThrow(source.shared_lattice() == sources.front().shared_lattice() &&
                    source.topology() == sources.front().topology() &&
                    source.stored() == sources.front().stored(),
                  dealii::ExcMessage("fields that are advected together must be alike"));
    const auto                  &lattice = sources.front().lattice();
    std::vector<NearBodies<dim>> near;
    std::vector<Field<dim>>      advected;
    near.reserve(sources.size());
    for (const auto &source : sources)
      {
        near.emplace_back(tracer, source);
        advected.emplace_back(source.shared_lattice(), tracer.bodies().topology);
      }
    const auto *divided    = advected.front().divided();
    const auto  advect_one = [&](const GridIndex<dim> &index) {
      if (divided && divided->kind(index) != SubLattice<dim>::Kind::whole)
        return;
      const auto place = lattice.point(index);
      const auto trace = tracer.trace(place, -tracer.dt());
      if (trace.near_body)
        for (std::size_t k = 0; k < sources.size(); ++k)
          advected[k](index) = near[k].value_at(near[k].whole(index), trace.foot);
      else if (const auto entered =
                 values_since_entry(tracer, trace, sources, going_on, condition, index);
               !entered.empty())
        for (std::size_t k = 0; k < sources.size(); ++k)
          advected[k](index) = entered[k];
      else
        {
          const auto value_of = far(trace, index);
          for (std::size_t k = 0; k < sources.size(); ++k)
            advected[k](index) = value_of(k);
        }
    };
    if (condition.neglected_variation() == 0)
      for_each(lattice.owned(), advect_one);
    else
      {
        const UniformRegions<dim> places(sources, reach, condition.neglected_variation(), divided);
        places.for_each_uniform_run([&](const GridIndex<dim> &first, const int n) {
          for (std::size_t k = 0; k < sources.size(); ++k)
            std::copy_n(sources[k].data(first), n, &advected[k](first));
        });
        places.for_each_other_run([&](GridIndex<dim> index, const int n) {
          for (int i = 0; i < n; ++i, ++index[0])
            advect_one(index);
        });
      }
    for_each_owned_part(divided, [&](const unsigned int part, const auto &of_part) {
      const auto trace = tracer.trace(of_part.place, -tracer.dt());
      for (std::size_t k = 0; k < sources.size(); ++k)
        advected[k].parts()[part] = near[k].value_at(of_part, trace.foot);
    });
    for (std::size_t k = 0; k < sources.size(); ++k)
      near[k].finish(advected[k], condition);
    return advected;
  }
} // namespace undine

#endif
