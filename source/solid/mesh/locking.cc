// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/locking.h>

#include <fmt/format.h>

namespace undine
{
  namespace
  {
    /// Of a law at rest [1].
    double
    poissons_ratio(const Material &material)
    {
      const auto   tangent = material.tangent(dealii::unit_symmetric_tensor<3>());
      const double lame    = tangent[0][0][1][1];
      const double shear   = tangent[0][1][0][1];
      return lame / (2 * (lame + shear));
    }


    template <int dim>
    bool
    keeps_thickness(const Body<dim> &body)
    {
      const auto at_rest = body.kinematics->thickness(*body.material, dealii::Tensor<2, dim>());
      return at_rest.tangent.norm() == 0;
    }
  } // namespace


  template <int dim>
  std::vector<std::string>
  locking_warnings(const SolidModel<dim> &model)
  {
    const double             most = 0.45;
    std::vector<std::string> result;
    if (model.numerics().degree > 1)
      return result;
    for (const auto &body : model.bodies())
      if (keeps_thickness(body) && !body.kinematics->separates_volumetric_part(*body.material) &&
          poissons_ratio(*body.material) > most)
        result.push_back(
          fmt::format("body '{}' has a Poisson's ratio of {:.4g} and elements of degree 1: it may "
                      "be far too stiff. Try: a nearly incompressible 'Material', or 'Solid "
                      "numerics/Element degree' 2.",
                      body.name,
                      poissons_ratio(*body.material)));
    return result;
  }


  template std::vector<std::string>
  locking_warnings(const SolidModel<2> &);
  template std::vector<std::string>
  locking_warnings(const SolidModel<3> &);
} // namespace undine
