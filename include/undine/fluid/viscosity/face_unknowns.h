// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_face_unknowns_h
#define undine_fluid_viscosity_face_unknowns_h

#include <undine/fluid/grid/face_place.h>
#include <undine/fluid/model/fluid_model.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>

namespace undine
{
  /// The velocities along one axis in a fluid with bodies in it as unknowns of linear equations,
  /// numbered across ranks: one for each face normal to the axis, or for each of its pieces where
  /// bodies divide it. Those that are prescribed have a number, too.
  template <int dim>
  class FaceUnknowns
  {
  public:
    using Number = dealii::types::global_dof_index;
    using Vector = dealii::TrilinosWrappers::MPI::Vector;

    /// The model must outlive it. Collective.
    FaceUnknowns(const FluidModel<dim>                    &model,
                 const unsigned int                        axis,
                 std::shared_ptr<const FluidTopology<dim>> topology);

    const FluidModel<dim> &
    model() const
    {
      return fluid;
    }

    unsigned int
    axis() const
    {
      return direction;
    }

    const std::shared_ptr<const FluidTopology<dim>> &
    topology() const
    {
      return open;
    }

    /// The numbers of this rank. @{
    const dealii::IndexSet &
    owned() const
    {
      return mine;
    }
    /// With those of neighbours that terms and fluxes of this rank may reach.
    dealii::IndexSet
    relevant() const;
    /// @}

    Number
    number(const FacePlace<dim> &place) const;

    /// rho V_f [kg]
    double
    mass(const FacePlace<dim> &place) const;

    /// Does a side of the domain give this velocity?
    bool
    is_prescribed(const FacePlace<dim> &place) const;

    /// A vector of zeros. Collective.
    Vector
    vector() const;

    /// The values of a vector, with means on divided faces and ghosts. Collective.
    void
    copy(Field<dim> &field, const Vector &values) const;

    /// action(FacePlace) in the order of the numbers of this rank.
    template <class Action>
    void
    for_each_owned(const Action &action) const;

    std::size_t
    memory_consumption() const;

  private:
    const FluidModel<dim>                          &fluid;
    const unsigned int                              direction;
    const std::shared_ptr<const FluidTopology<dim>> open;
    Field<dim>                                      numbers; ///< exact up to 2^53
    dealii::IndexSet                                mine;
  };


  template <int dim>
  template <class Action>
  void
  FaceUnknowns<dim>::for_each_owned(const Action &action) const
  {
    const auto &divided = open->faces[direction];
    for_each(fluid.grid().faces(direction)->owned(), [&](const GridIndex<dim> &face) {
      if (divided.kind(face) == SubLattice<dim>::Kind::whole)
        action(FacePlace<dim>{face, -1});
    });
    for (std::size_t k = 0; k < divided.all().size(); ++k)
      if (divided.owns(k))
        action(FacePlace<dim>{divided.all()[k].index, static_cast<int>(k)});
  }
} // namespace undine

#endif
