// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_advection_h
#define undine_fluid_advection_h

#include <undine/fluid/flow.h>
#include <undine/fluid/quiet_places.h>

#include <string>

namespace undine
{
  /// How a field is carried with the flow for one step: ds/dt + v.grad s = 0. The same code serves
  /// scalars in cells and velocities on faces.
  template <int dim>
  class Advection
  {
  public:
    virtual ~Advection() = default;

    virtual void
    add_options(const Options &options) = 0;

    /// In a few words: "MacCormack, limited".
    virtual std::string
    summary() const = 0;

    /// The field at t + h from the field at t, on what bodies leave of the grid now. Collective.
    virtual Field<dim>
    advect(const Flow<dim>              &flow,
           const Field<dim>             &field,
           const BoundaryCondition<dim> &condition) const = 0;
  };

  /// `field` with the ghost layers and boundary points that the flow asks for.
  template <int dim>
  Field<dim>
  completed(const Flow<dim> &flow, Field<dim> field, const BoundaryCondition<dim> &condition);

  /// What is seen from the feet of paths that come near a body.
  template <int dim>
  class NearBodies
  {
  public:
    /// `source` is what completed() returned. The references must outlive it. Collective.
    NearBodies(const Flow<dim> &flow, const Field<dim> &source);

    /// The value that the path from `foot` brings to the point `index` or a part of it, which is at
    /// `place`; NaN if nothing could be seen there, of scalars only.
    double
    value_at(const GridIndex<dim>     &index,
             const dealii::Point<dim> &place,
             const dealii::Point<dim> &foot) const;

    /// Cells and components to which nothing was brought are filled, see fill_unknown(); divided
    /// points take the mean of their parts. Collective.
    void
    finish(Field<dim> &carried, const BoundaryCondition<dim> &condition) const;

  private:
    const Flow<dim>                           &flow;
    const Lattice<dim>                        &lattice;
    unsigned int                               axis; ///< of a velocity; no_axis: scalar
    std::unique_ptr<const VisibleSamples<dim>> samples;
  };

  /// The same field on what bodies leave of the grid now. Collective.
  template <int dim>
  Field<dim>
  kept_in_place(const Flow<dim>              &flow,
                const Field<dim>             &field,
                const BoundaryCondition<dim> &condition);

  /// The field at t + h on what bodies leave of the grid now: `far(trace, index)` of paths that
  /// keep away from bodies; near them all methods are alike, see NearBodies; quiet places keep
  /// what they have. `source` is what completed() returned with the same condition; `far` looks no
  /// further than `reach` points away. Collective.
  template <int dim, class Far>
  Field<dim>
  carry(const Flow<dim>              &flow,
        const Field<dim>             &source,
        const BoundaryCondition<dim> &condition,
        const GridIndex<dim>         &reach,
        Far                         &&far)
  {
    const auto           &bodies = flow.bodies();
    const NearBodies<dim> near(flow, source);
    Field<dim>            carried(source.shared_lattice(), bodies.open_parts);
    const auto           *divided   = carried.divided();
    const auto            carry_one = [&](const GridIndex<dim> &index) {
      if (divided && divided->kind(index) != LatticeParts<dim>::Kind::whole)
        return;
      const auto place = source.lattice().point(index);
      const auto trace = flow.trace(place, -flow.dt());
      carried(index) =
        trace.near_body ? near.value_at(index, place, trace.foot) : far(trace, index);
    };
    if (condition.neglected_variation() == 0)
      for_each(carried.owned(), carry_one);
    else
      {
        const QuietPlaces<dim> places(source, reach, condition.neglected_variation(), divided);
        places.for_each_run(true, [&](const GridIndex<dim> &first, const int n) {
          std::copy_n(source.data(first), n, &carried(first));
        });
        places.for_each_run(false, [&](GridIndex<dim> index, const int n) {
          for (int i = 0; i < n; ++i, ++index[0])
            carry_one(index);
        });
      }
    for_each_part(carried, [&](double &value, const auto &place, const GridIndex<dim> &index) {
      value = near.value_at(index, place, flow.trace(place, -flow.dt()).foot);
    });
    near.finish(carried, condition);
    return carried;
  }
} // namespace undine

#endif
