// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/assembly/mean_dilatation.h>

namespace undine
{
  template <int dim>
  MeanDilatation<dim>::MeanDilatation(const RestGeometry<dim> &geometry)
    : geometry(geometry)
    // Constants below bilinear, linear functions below biquadratic displacements.
    , n_functions(geometry.n_nodes() == dealii::GeometryInfo<dim>::vertices_per_cell ? 1 : dim + 1)
    , inverse_mass(n_functions)
    , gradient(n_functions, geometry.n_nodes() * dim)
  {
  }


  template <int dim>
  double
  MeanDilatation<dim>::basis(const unsigned int function, const unsigned int point) const
  {
    if (function == 0)
      return 1;
    return (geometry.position(cell, point)[function - 1] - centre[function - 1]) / width;
  }


  template <int dim>
  void
  MeanDilatation<dim>::set_cell(const unsigned int new_cell)
  {
    cell   = new_cell;
    centre = geometry.centre(cell);
    width  = geometry.width(cell);

    inverse_mass = 0;
    for (unsigned int q = 0; q < geometry.n_points(); ++q)
      for (unsigned int i = 0; i < n_functions; ++i)
        for (unsigned int j = 0; j < n_functions; ++j)
          inverse_mass(i, j) += basis(i, q) * basis(j, q) * geometry.JxW(cell, q);
    inverse_mass.gauss_jordan();
  }


  template <int dim>
  void
  MeanDilatation<dim>::reinit(const unsigned int         new_cell,
                              const Material            &new_material,
                              const std::vector<double> &jacobians)
  {
    set_cell(new_cell);
    material    = &new_material;
    dilatations = project(jacobians);
    std::vector<double> volumetric_stresses;
    for (const double dilatation : dilatations)
      volumetric_stresses.push_back(material->volumetric_stress(dilatation));
    pressures = project(volumetric_stresses);
  }


  template <int dim>
  std::vector<double>
  MeanDilatation<dim>::project(const std::vector<double> &values) const
  {
    std::vector<double> moments(n_functions, 0.);
    for (unsigned int q = 0; q < geometry.n_points(); ++q)
      for (unsigned int i = 0; i < n_functions; ++i)
        moments[i] += basis(i, q) * values[q] * geometry.JxW(cell, q);

    std::vector<double> result(geometry.n_points(), 0.);
    for (unsigned int i = 0; i < n_functions; ++i)
      {
        double coefficient = 0;
        for (unsigned int j = 0; j < n_functions; ++j)
          coefficient += inverse_mass(i, j) * moments[j];
        for (unsigned int q = 0; q < geometry.n_points(); ++q)
          result[q] += coefficient * basis(i, q);
      }
    return result;
  }


  template <int dim>
  double
  MeanDilatation<dim>::pressure(const unsigned int point) const
  {
    return pressures[point];
  }


  template <int dim>
  double
  MeanDilatation<dim>::energy() const
  {
    double sum = 0;
    for (unsigned int q = 0; q < geometry.n_points(); ++q)
      sum += material->volumetric_energy(dilatations[q]) * geometry.JxW(cell, q);
    return sum;
  }


  template <int dim>
  void
  MeanDilatation<dim>::start_gradient()
  {
    gradient = 0;
  }


  template <int dim>
  void
  MeanDilatation<dim>::add_gradient(const unsigned int         point,
                                    const std::vector<double> &volume_gradients)
  {
    for (unsigned int i = 0; i < n_functions; ++i)
      {
        const double weight = basis(i, point) * geometry.JxW(cell, point);
        for (unsigned int dof = 0; dof < volume_gradients.size(); ++dof)
          gradient(i, dof) += weight * volume_gradients[dof];
      }
  }


  template <int dim>
  void
  MeanDilatation<dim>::add_tangent(dealii::FullMatrix<double> &tangent) const
  {
    dealii::FullMatrix<double> stiffness(n_functions);
    for (unsigned int q = 0; q < geometry.n_points(); ++q)
      {
        const double weight = material->volumetric_tangent(dilatations[q]) * geometry.JxW(cell, q);
        for (unsigned int i = 0; i < n_functions; ++i)
          for (unsigned int j = 0; j < n_functions; ++j)
            stiffness(i, j) += weight * basis(i, q) * basis(j, q);
      }
    dealii::FullMatrix<double> half(n_functions), middle(n_functions);
    inverse_mass.mmult(half, stiffness);
    half.mmult(middle, inverse_mass);
    tangent.triple_product(middle, gradient, gradient, true, false);
  }


  template class MeanDilatation<2>;
  template class MeanDilatation<3>;
} // namespace undine
