// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_viscosity_viscous_terms_h
#define undine_fluid_viscosity_viscous_terms_h

#include <undine/fluid/model/fluid_model.h>
#include <undine/fluid/viscosity/face_links.h>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace undine
{
  /// One of the squares whose sum is the power of friction: weight (sum_k c_k v_k)^2 of velocities
  /// along one axis. The force on what moves with v_k is -weight (sum c v) c_k.
  template <int dim>
  struct ViscousTerm
  {
    /// A place on the domain's boundary, where the velocity is given; its coefficient is -1.
    struct Wall
    {
      const Boundary<dim> *boundary = nullptr; ///< none
      unsigned int         normal   = 0;
      dealii::Point<dim>   place;
    };

    double                                         weight; ///< [kg/s] over squared coefficients
    std::vector<std::pair<FacePlace<dim>, double>> faces;
    std::vector<std::pair<unsigned int, double>>   nodes; ///< of the surfaces in the fluid
    Wall                                           wall;
  };


  /// The power of friction in a fluid and on all no-slip surfaces and boundaries, of the velocity
  /// along one axis i (I6):
  ///
  ///     power = sum_c mu/V_c (sum +- a_f v_f + sum_k B_ck u_k)^2            cells and components
  ///           + sum mu A/d (v_f - v_g)^2                         neighbours in a plane of faces
  ///           + sum mu A/d (v_f - u)^2                contacts with surfaces, sides of the domain
  ///
  /// The first is dv/dx_i, exact by Gauss' theorem for linear v. In each plane x_i = const there is
  /// one velocity at the centroid of each piece; A is the area over which what moves with it, as
  /// far as the middles of the cells beside it, touches others, d the distance in the plane. All is
  /// exact for linear v in 2D.
  template <int dim>
  class ViscousTerms
  {
  public:
    using Action = std::function<void(const ViscousTerm<dim> &)>;

    /// `viscosity` mu [Pa s]. The references must outlive it.
    ViscousTerms(const FluidModel<dim>     &model,
                 const unsigned int         axis,
                 const FluidTopology<dim>  &open,
                 const NoSlipSurfaces<dim> &walls,
                 const double               viscosity);

    /// Call `action` for every term, each on one rank only. Its places are owned, or next to owned
    /// ones.
    void
    for_each(const Action &action) const;

  private:
    using Term = ViscousTerm<dim>;

    void
    cells(const Action &action) const;
    void
    components(const Action &action) const;
    void
    neighbours(const Action &action) const;
    void
    sides(const Action &action) const;
    void
    contacts(const Action &action) const;

    void
    add(Term &term, const FacePlace<dim> &place, const double sign) const;
    double
    area(const FacePlace<dim> &place) const;

    const FluidModel<dim>     &model;
    const MacGrid<dim>        &grid;
    const unsigned int         axis;
    const FluidTopology<dim>  &open;
    const NoSlipSurfaces<dim> &walls;
    const double               viscosity;
    const FaceLinks<dim>       links;
  };
} // namespace undine

#endif
