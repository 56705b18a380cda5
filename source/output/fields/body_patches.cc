// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/parallel/throw_together.h>
#include <undine/output/fields/body_patches.h>

#include <deal.II/numerics/data_out.h>

namespace undine
{
  namespace
  {
    /// deal.II's patches for the locally owned cells, handed out.
    template <int dim>
    class BodyDataOut : public dealii::DataOut<dim>
    {
    public:
      std::vector<dealii::DataOutBase::Patch<dim>>
      take_patches()
      {
        return std::move(this->patches);
      }
    };


    /// Numbers that are constant on each cell, by active cell index; zero on cells of other ranks.
    struct CellData
    {
      dealii::Vector<double> body;
      dealii::Vector<double> stress; ///< von Mises [Pa]
      dealii::Vector<double> volume; ///< det F [1]
    };


    /// H from the gradients of the nodes and the displacements of their degrees of freedom.
    template <int dim>
    dealii::Tensor<2, dim>
    displacement_gradient(const std::vector<dealii::Tensor<1, dim>> &gradients,
                          const std::vector<double>                 &dof_values)
    {
      dealii::Tensor<2, dim> H;
      for (unsigned int node = 0; node < gradients.size(); ++node)
        for (unsigned int axis = 0; axis < dim; ++axis)
          H[axis] += dof_values[node * dim + axis] * gradients[node];
      return H;
    }


    /// Means of one cell, weighted by rest volume.
    template <int dim>
    void
    fill_cell(CellData                                    &data,
              const SolidModel<dim>                       &model,
              const unsigned int                           cell,
              const dealii::TrilinosWrappers::MPI::Vector &displacement)
    {
      const auto         &geometry = model.geometry();
      const auto         &body     = model.bodies()[geometry.body(cell)];
      const unsigned int  index    = geometry.cell(cell)->active_cell_index();
      std::vector<double> dof_values;
      for (const auto dof : geometry.dofs(cell))
        dof_values.push_back(displacement(dof));

      double                              volume = 0, stress = 0, deformed_volume = 0;
      std::vector<dealii::Tensor<1, dim>> gradients;
      for (unsigned int point = 0; point < geometry.n_points(); ++point)
        {
          geometry.gradients(gradients, cell, point);
          const auto   H   = displacement_gradient(gradients, dof_values);
          const double JxW = geometry.JxW(cell, point);
          volume += JxW;
          stress += JxW * von_mises_stress(body, H);
          deformed_volume += JxW * body.kinematics->stress(*body.material, H).jacobian;
        }
      data.body(index)   = geometry.body(cell);
      data.stress(index) = stress / volume;
      data.volume(index) = deformed_volume / volume;
    }


    template <int dim>
    CellData
    cell_data(const SolidModel<dim> &model, const dealii::TrilinosWrappers::MPI::Vector &ghosted)
    {
      CellData           data;
      const unsigned int n_cells = model.triangulation().n_active_cells();
      for (auto *values : {&data.body, &data.stress, &data.volume})
        values->reinit(n_cells);
      std::string failure;
      try
        {
          for (unsigned int cell = 0; cell < model.geometry().n_cells(); ++cell)
            fill_cell(data, model, cell, ghosted);
        }
      catch (const SolveError &error)
        {
          failure = error.what();
        }
      throw_together(failure, model.communicator());
      return data;
    }


    /// Multilinear interpolation between the corners of a patch.
    template <int dim>
    dealii::Point<dim>
    rest_position(const dealii::DataOutBase::Patch<dim> &patch, const unsigned int point)
    {
      const unsigned int n = patch.n_subdivisions;
      dealii::Point<dim> unit;
      unsigned int       rest = point;
      for (unsigned int axis = 0; axis < dim; ++axis, rest /= n + 1)
        unit[axis] = double(rest % (n + 1)) / n;
      dealii::Point<dim> position;
      for (const unsigned int v : dealii::GeometryInfo<dim>::vertex_indices())
        position += dealii::GeometryInfo<dim>::d_linear_shape_function(unit, v) *
                    dealii::Tensor<1, dim>(patch.vertices[v]);
      return position;
    }


    /// Move the points by the displacement, which the first `dim` components hold.
    template <int dim>
    void
    deform(dealii::DataOutBase::Patch<dim> &patch)
    {
      const unsigned int      n_components = patch.data.n_rows();
      const unsigned int      n_points     = patch.data.n_cols();
      dealii::Table<2, float> data(n_components + dim, n_points);
      for (unsigned int point = 0; point < n_points; ++point)
        {
          for (unsigned int c = 0; c < n_components; ++c)
            data(c, point) = patch.data(c, point);
          const auto rest = rest_position(patch, point);
          for (unsigned int axis = 0; axis < dim; ++axis)
            data(n_components + axis, point) = rest[axis] + patch.data(axis, point);
        }
      patch.data.swap(data);
      patch.points_are_available = true;
    }
  } // namespace


  template <int dim>
  double
  von_mises_stress(const Body<dim> &body, const dealii::Tensor<2, dim> &displacement_gradient)
  {
    const auto plane = body.kinematics->stress(*body.material, displacement_gradient);
    auto       F     = dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
    F[2][2]          = plane.thickness_stretch;
    for (unsigned int a = 0; a < dim; ++a)
      for (unsigned int b = 0; b < dim; ++b)
        F[a][b] = (a == b ? 1. : 0.) + displacement_gradient[a][b];
    const auto   P = body.material->stress(F);
    const double J = dealii::determinant(F);
    // A law that tolerates inversion is one for small strains, where both stresses are the same.
    const auto sigma    = J > 0 ? P * dealii::transpose(F) / J : P;
    const auto deviator = dealii::deviator(dealii::symmetrize(sigma));
    return std::sqrt(1.5) * deviator.norm();
  }


  template <int dim>
  Patches<dim>
  body_patches(const SolidModel<dim> &model,
               const SolidState      &state,
               const Configuration    configuration)
  {
    using namespace dealii;
    const auto displacement = model.ghosted(state.displacement);
    const auto velocity     = model.ghosted(state.velocity);
    const auto cells        = cell_data(model, displacement);

    Patches<dim> result;
    result.name = "bodies";
    result.add_vector("displacement", "m");
    result.add_vector("velocity", "m/s");
    result.add_scalar("body", "1");
    result.add_scalar("von_Mises_stress", "Pa");
    result.add_scalar("volume_ratio", "1");

    BodyDataOut<dim>                                                            data_out;
    const std::vector<DataComponentInterpretation::DataComponentInterpretation> vector(
      dim, DataComponentInterpretation::component_is_part_of_vector);
    const auto nodal = BodyDataOut<dim>::type_dof_data;
    const auto cell  = BodyDataOut<dim>::type_cell_data;
    data_out.attach_dof_handler(model.dof_handler());
    data_out.add_data_vector(
      displacement, std::vector<std::string>(dim, "displacement"), nodal, vector);
    data_out.add_data_vector(velocity, std::vector<std::string>(dim, "velocity"), nodal, vector);
    data_out.add_data_vector(cells.body, "body", cell);
    data_out.add_data_vector(cells.stress, "von_Mises_stress", cell);
    data_out.add_data_vector(cells.volume, "volume_ratio", cell);
    data_out.build_patches(
      model.mapping(), model.dof_handler().get_fe().degree, BodyDataOut<dim>::no_curved_cells);
    result.patches = data_out.take_patches();
    if (configuration == Configuration::deformed)
      for (auto &patch : result.patches)
        deform(patch);
    return result;
  }


  template double
  von_mises_stress(const Body<2> &, const dealii::Tensor<2, 2> &);
  template double
  von_mises_stress(const Body<3> &, const dealii::Tensor<2, 3> &);
  template Patches<2>
  body_patches(const SolidModel<2> &, const SolidState &, Configuration);
  template Patches<3>
  body_patches(const SolidModel<3> &, const SolidState &, Configuration);
} // namespace undine
