// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/solid/mesh/solid_model.h>
#include <undine/solid/mesh/supports.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

namespace undine
{
  namespace
  {
    using Index = dealii::types::global_dof_index;


    template <int dim>
    std::vector<Index>
    cell_dofs(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell)
    {
      std::vector<Index> result(cell->get_fe().n_dofs_per_cell());
      cell->get_dof_indices(result);
      return result;
    }
  } // namespace


  template <int dim>
  void
  SolidModel<dim>::declare(const Options &options)
  {
    read_bodies<dim>(options.section("Bodies"));
    SolidNumerics numerics(options);
  }


  template <int dim>
  SolidModel<dim>::SolidModel(const Options &options, const MPI_Comm communicator)
    : SolidModel(
        std::make_shared<const SolidNumerics>(options),
        std::make_shared<const std::vector<Body<dim>>>(read_bodies<dim>(options.section("Bodies"))),
        {},
        communicator)
  {
    check_supports(*this, find_fixed());
  }


  template <int dim>
  SolidModel<dim>::SolidModel(const SolidModel &all, const std::vector<bool> &kept)
    : SolidModel(all.solid_numerics, all.all_bodies, kept, all.communicator())
  {
  }


  /// `some`: empty for all.
  template <int dim>
  SolidModel<dim>::SolidModel(std::shared_ptr<const SolidNumerics>          numerics,
                              std::shared_ptr<const std::vector<Body<dim>>> bodies,
                              const std::vector<bool>                      &some,
                              const MPI_Comm                                communicator)
    : solid_numerics(std::move(numerics))
    , all_bodies(std::move(bodies))
    , kept(some.empty() ? std::vector<bool>(all_bodies->size(), true) : some)
    , straight(1)
    , mesh(communicator,
           dealii::Triangulation<dim>::none,
           false,
           dealii::parallel::shared::Triangulation<dim>::partition_metis)
    , element(dealii::FE_Q<dim>(solid_numerics->degree), dim)
    , dofs(mesh)
  {
    const auto sides = make_solid_mesh(mesh, *all_bodies, kept);
    loaded_faces     = select_faces(mesh, *all_bodies, kept, sides);
    distribute_dofs();
    collect_nodes();
    collect_fixed();
    make_sparsity();
    rest = std::make_unique<const RestGeometry<dim>>(straight, dofs);
  }


  template <int dim>
  void
  SolidModel<dim>::distribute_dofs()
  {
    dofs.distribute_dofs(element);
    // Not the locally relevant ones, which are all: no cell is artificial.
    relevant = dealii::DoFTools::extract_locally_active_dofs(dofs);
  }


  template <int dim>
  void
  SolidModel<dim>::collect_nodes()
  {
    axes.resize(dofs.n_dofs());
    rest_positions.resize(dofs.n_dofs());
    const auto &nodes = element.get_unit_support_points();
    for (const auto &cell : dofs.active_cell_iterators())
      {
        const auto indices = cell_dofs<dim>(cell);
        for (unsigned int i = 0; i < indices.size(); ++i)
          {
            axes[indices[i]]           = element.system_to_component_index(i).first;
            rest_positions[indices[i]] = straight.transform_unit_to_real_cell(cell, nodes[i]);
          }
      }
  }


  /// Returns those of all ranks.
  template <int dim>
  std::vector<FixedDof>
  SolidModel<dim>::find_fixed() const
  {
    std::map<Index, FixedDof> all;
    std::vector<Index>        indices(element.n_dofs_per_face());
    for (const auto &face : loaded_faces)
      {
        const auto &boundary = (*all_bodies)[face.body].boundaries[face.boundary];
        if (!boundary.fixes_displacement())
          continue;
        const typename dealii::DoFHandler<dim>::active_cell_iterator cell(
          &mesh, face.cell->level(), face.cell->index(), &dofs);
        cell->face(face.face)->get_dof_indices(indices);
        for (const Index dof : indices)
          if (boundary.directions[axes[dof]])
            all.insert({dof, {dof, face.body, face.boundary, axes[dof]}});
      }
    std::vector<FixedDof> result;
    result.reserve(all.size());
    for (const auto &entry : all)
      result.push_back(entry.second);
    return result;
  }


  template <int dim>
  void
  SolidModel<dim>::collect_fixed()
  {
    fixed_of_all_ranks.set_size(dofs.n_dofs());
    for (const auto &fixed : find_fixed())
      {
        fixed_of_all_ranks.add_index(fixed.dof);
        if (locally_owned().is_element(fixed.dof))
          owned_fixed.push_back(fixed);
      }
    fixed_of_all_ranks.compress();
  }


  template <int dim>
  void
  SolidModel<dim>::make_sparsity()
  {
    dealii::DynamicSparsityPattern pattern(dofs.n_dofs(), dofs.n_dofs(), relevant);
    dealii::DoFTools::make_sparsity_pattern(
      dofs, pattern, dealii::AffineConstraints<double>(), true, mesh.locally_owned_subdomain());
    dealii::SparsityTools::distribute_sparsity_pattern(
      pattern, locally_owned(), communicator(), relevant);
    sparsity.reinit(locally_owned(), pattern, communicator());
  }


  template <int dim>
  const std::vector<Body<dim>> &
  SolidModel<dim>::bodies() const
  {
    return *all_bodies;
  }


  template <int dim>
  bool
  SolidModel<dim>::has(const unsigned int body) const
  {
    return kept[body];
  }


  template <int dim>
  const SolidNumerics &
  SolidModel<dim>::numerics() const
  {
    return *solid_numerics;
  }


  template <int dim>
  MPI_Comm
  SolidModel<dim>::communicator() const
  {
    return mesh.get_communicator();
  }


  template <int dim>
  const dealii::parallel::shared::Triangulation<dim> &
  SolidModel<dim>::triangulation() const
  {
    return mesh;
  }


  template <int dim>
  const dealii::DoFHandler<dim> &
  SolidModel<dim>::dof_handler() const
  {
    return dofs;
  }


  template <int dim>
  const dealii::Mapping<dim> &
  SolidModel<dim>::mapping() const
  {
    return straight;
  }


  template <int dim>
  const RestGeometry<dim> &
  SolidModel<dim>::geometry() const
  {
    return *rest;
  }


  template <int dim>
  const std::vector<LoadedFace<dim>> &
  SolidModel<dim>::faces() const
  {
    return loaded_faces;
  }


  template <int dim>
  const dealii::IndexSet &
  SolidModel<dim>::locally_owned() const
  {
    return dofs.locally_owned_dofs();
  }


  template <int dim>
  const dealii::IndexSet &
  SolidModel<dim>::locally_relevant() const
  {
    return relevant;
  }


  template <int dim>
  unsigned int
  SolidModel<dim>::axis(const Index dof) const
  {
    return axes[dof];
  }


  template <int dim>
  const dealii::Point<dim> &
  SolidModel<dim>::rest_position(const Index dof) const
  {
    return rest_positions[dof];
  }


  template <int dim>
  const std::vector<FixedDof> &
  SolidModel<dim>::fixed() const
  {
    return owned_fixed;
  }


  template <int dim>
  const dealii::IndexSet &
  SolidModel<dim>::all_fixed() const
  {
    return fixed_of_all_ranks;
  }


  template <int dim>
  double
  SolidModel<dim>::prescribed_displacement(const FixedDof &fixed, const double time) const
  {
    const auto &body     = (*all_bodies)[fixed.body];
    const auto &boundary = body.boundaries[fixed.boundary];
    const auto &position = rest_positions[fixed.dof];
    if (boundary.kind == BodyBoundary<dim>::Kind::clamp)
      return body.displacement.value(position, 0., fixed.axis);
    return boundary.motion.value(position, time, fixed.axis);
  }


  template <int dim>
  std::vector<Index>
  SolidModel<dim>::canonical_order() const
  {
    std::vector<Index> result(dofs.n_dofs(), dealii::numbers::invalid_dof_index);
    Index              next = 0;
    for (const auto &cell : dofs.active_cell_iterators())
      for (const Index dof : cell_dofs<dim>(cell))
        if (result[dof] == dealii::numbers::invalid_dof_index)
          result[dof] = next++;
    return result;
  }


  template <int dim>
  typename SolidModel<dim>::Vector
  SolidModel<dim>::vector() const
  {
    return Vector(locally_owned(), communicator());
  }


  template <int dim>
  typename SolidModel<dim>::Vector
  SolidModel<dim>::ghosted(const Vector &owned) const
  {
    Vector result(locally_owned(), relevant, communicator());
    result = owned;
    return result;
  }


  template <int dim>
  typename SolidModel<dim>::Matrix
  SolidModel<dim>::matrix() const
  {
    return Matrix(sparsity);
  }


  template class SolidModel<2>;
  template class SolidModel<3>;
} // namespace undine
