// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_material_material_h
#define undine_solid_material_material_h

#include <undine/base/options/options.h>

#include <deal.II/base/tensor.h>

namespace undine
{
  /// A hyperelastic law, always in three dimensions: plane strain and plane stress embed the
  /// deformation gradient F [1] of a plane body (kinematics.h), so that no law knows of dimensions.
  /// One law is one .cc file that registers itself.
  class Material
  {
  public:
    using Gradient = dealii::Tensor<2, 3>; ///< F, or first Piola-Kirchhoff stress P [Pa]
    using Tangent  = dealii::Tensor<4, 3>; ///< A_ijkl = dP_ij / dF_kl [Pa]

    virtual ~Material() = default;

    /// Declare and read the constants of the law.
    virtual void
    add_options(const Options &options) = 0;

    /// W(F) [J/m^3], zero at rest.
    virtual double
    energy(const Gradient &F) const = 0;

    /// P = dW/dF [Pa].
    virtual Gradient
    stress(const Gradient &F) const = 0;

    /// A = dP/dF [Pa]; A_ijkl = A_klij.
    virtual Tangent
    tangent(const Gradient &F) const = 0;

    /// True if the law is W = W_distortional(F) + U(det F) with so stiff a U that displacements
    /// alone lock: then the three functions above give the distortional part only, and the element
    /// takes U at the dilatation averaged over the cell (mean_dilatation.h).
    virtual bool
    has_separate_volumetric_part() const;

    /// U(J) [J/m^3], U'(J) [Pa] and U''(J) [Pa]; zero for laws without a separate part. @{
    virtual double
    volumetric_energy(double J) const;
    virtual double
    volumetric_stress(double J) const;
    virtual double
    volumetric_tangent(double J) const;
    /// @}

    /// Is the law valid for det F <= 0, as a linear law is? The others throw SolveError there, in
    /// whichever of their functions needs det F > 0.
    virtual bool
    tolerates_inversion() const;

    /// W(Q F) = W(F) for every rotation Q? True for all but laws of small rotations.
    virtual bool
    is_objective() const;

    /// lambda + 2 mu at rest [Pa]: density times the squared speed of pressure waves.
    virtual double
    p_wave_modulus() const = 0;
  };
} // namespace undine

#endif
