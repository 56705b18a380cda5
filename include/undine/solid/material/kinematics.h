// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_material_kinematics_h
#define undine_solid_material_kinematics_h

#include <undine/base/options/options.h>
#include <undine/solid/material/material.h>

#include <deal.II/base/tensor.h>

#include <memory>

namespace undine
{
  /// The stress of a material at one point of a body.
  template <int dim>
  struct PointStress
  {
    dealii::Tensor<2, dim> stress;            ///< first Piola-Kirchhoff stress P [Pa]
    double                 jacobian;          ///< det F in three dimensions [1]
    double                 thickness_stretch; ///< F_33 of a plane body, 1 in 3D [1]
  };

  /// The same with the tangent A_ijkl = dP_ij / dF_kl [Pa]; A_ijkl = A_klij.
  template <int dim>
  struct PointResponse : PointStress<dim>
  {
    dealii::Tensor<4, dim> tangent;
  };

  /// The stretch of a plane body in the direction of its thickness.
  template <int dim>
  struct Thickness
  {
    double                 stretch; ///< F_33, 1 in 3D [1]
    dealii::Tensor<2, dim> tangent; ///< dF_33 / dH_kl [1]
  };

  /// How the displacement gradient H = du/dX [1] of a body in `dim` dimensions becomes the
  /// deformation gradient F of a material point in three dimensions, and how stress and tangent
  /// come back (S7), (S8):
  ///
  ///     3D            F = I + H
  ///     plane strain  F = I + H in the plane, F_33 = 1, F_a3 = F_3a = 0
  ///     plane stress  F = I + H in the plane, F_a3 = F_3a = 0, F_33 from P_33(F) = 0;
  ///                   A_abcd - A_ab33 A_33cd / A_3333 is the tangent,
  ///                   dF_33/dH_cd = -A_33cd / A_3333
  ///
  /// [Holzapfel, Nonlinear Solid Mechanics, chapter 6; de Souza Neto, Peric, Owen, Computational
  /// Methods for Plasticity, section 9.2 for the plane stress projection].
  ///
  /// All functions throw SolveError if det F is not a positive number and the law does not tolerate
  /// inversion, or if no F_33 > 0 makes P_33 = 0. They are not collective: callers that loop over
  /// the cells of one rank must pass errors on to the other ranks.
  template <int dim>
  class Kinematics
  {
  public:
    using Gradient = dealii::Tensor<2, dim>;

    virtual ~Kinematics() = default;

    /// Declare and read the keys; there are none unless a derived class has some.
    virtual void
    add_options(const Options &options);

    /// True if the three functions below leave out the law's U(det F), which the element then adds
    /// at the dilatation averaged over the cell. Never so in plane stress: a plane-stress body is
    /// free to get thinner, does not lock, and takes U at each point.
    virtual bool
    separates_volumetric_part(const Material &material) const = 0;

    /// Stress and tangent.
    virtual PointResponse<dim>
    respond(const Material &material, const Gradient &displacement_gradient) const = 0;

    /// Stress alone.
    virtual PointStress<dim>
    stress(const Material &material, const Gradient &displacement_gradient) const = 0;

    /// F_33 and its derivative. Where it is always 1, no H is refused.
    virtual Thickness<dim>
    thickness(const Material &material, const Gradient &displacement_gradient) const = 0;

    /// Energy density W [J/m^3].
    virtual double
    energy(const Material &material, const Gradient &displacement_gradient) const = 0;
  };

  /// In 2D what the key `Plane state` of this section names, in 3D (no key) the only one there is.
  template <int dim>
  std::unique_ptr<Kinematics<dim>>
  choose_kinematics(const Options &options);

  template <>
  std::unique_ptr<Kinematics<2>>
  choose_kinematics<2>(const Options &options);
  template <>
  std::unique_ptr<Kinematics<3>>
  choose_kinematics<3>(const Options &options);
} // namespace undine

#endif
