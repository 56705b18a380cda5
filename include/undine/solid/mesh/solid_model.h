// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_solid_mesh_solid_model_h
#define undine_solid_mesh_solid_model_h

#include <undine/solid/mesh/body.h>
#include <undine/solid/mesh/rest_geometry.h>
#include <undine/solid/mesh/solid_mesh.h>
#include <undine/solid/mesh/solid_numerics.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping_q.h>
#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>
#include <deal.II/lac/trilinos_vector.h>

#include <memory>
#include <vector>

namespace undine
{
  /// A component of a node whose displacement a boundary prescribes.
  struct FixedDof
  {
    dealii::types::global_dof_index dof;
    unsigned int                    body;     ///< index
    unsigned int                    boundary; ///< index in the body
    unsigned int                    axis;
  };

  /// The bodies of a scene, discretised: Lagrange elements of degree 1 or 2 for the displacement on
  /// straight-edged cells at rest, all bodies in one mesh, distributed by cells. Constant during a
  /// run. In 2D, volumes, masses and forces are those of 1 m of depth.
  template <int dim>
  class SolidModel
  {
  public:
    using Vector = dealii::TrilinosWrappers::MPI::Vector;
    using Matrix = dealii::TrilinosWrappers::SparseMatrix;
    using Index  = dealii::types::global_dof_index;

    /// Declare the keys of the sections `Bodies` and `Solid numerics` without building anything.
    static void
    declare(const Options &options);

    /// Read these sections and build. Collective. Throws InputError, FileError.
    SolidModel(const Options &options, MPI_Comm communicator);

    /// A model of some of the bodies, as if there were no others. Bodies keep their numbers; those
    /// that are not `kept` have no cells. Collective.
    SolidModel(const SolidModel &all, const std::vector<bool> &kept);

    /// All bodies of the scene, also those without cells in this model.
    const std::vector<Body<dim>> &
    bodies() const;

    /// Does the body have cells?
    bool
    has(unsigned int body) const;

    const SolidNumerics &
    numerics() const;
    MPI_Comm
    communicator() const;

    /// Every rank knows all cells (none is artificial).
    const dealii::parallel::shared::Triangulation<dim> &
    triangulation() const;
    const dealii::DoFHandler<dim> &
    dof_handler() const;
    const dealii::Mapping<dim> &
    mapping() const;

    /// Quadrature on the locally owned cells at rest.
    const RestGeometry<dim> &
    geometry() const;

    /// The boundary faces with a condition, of all ranks.
    const std::vector<LoadedFace<dim>> &
    faces() const;

    /// Numbers of the degrees of freedom that this rank owns.
    const dealii::IndexSet &
    locally_owned() const;

    /// Degrees of freedom of the locally owned cells.
    const dealii::IndexSet &
    locally_relevant() const;

    /// The axis that a degree of freedom, known to any rank, moves along.
    unsigned int
    axis(Index dof) const;

    /// Position at rest of the node of a degree of freedom, known to any rank [m].
    const dealii::Point<dim> &
    rest_position(Index dof) const;

    /// Locally owned degrees of freedom with a prescribed displacement, in ascending order.
    const std::vector<FixedDof> &
    fixed() const;

    /// The fixed degrees of freedom of all ranks.
    const dealii::IndexSet &
    all_fixed() const;

    /// g [m] of a prescribed degree of freedom.
    double
    prescribed_displacement(const FixedDof &fixed, double time) const;

    /// For each degree of freedom its number in an order that does not depend on the number of
    /// ranks: that in which a loop over all cells meets them first.
    std::vector<Index>
    canonical_order() const;

    /// A zero vector over the locally owned degrees of freedom.
    Vector
    vector() const;

    /// A copy of such a vector that can be read at all locally relevant ones.
    Vector
    ghosted(const Vector &owned) const;

    /// A zero matrix with entries for all pairs of degrees of freedom that share a cell.
    Matrix
    matrix() const;

  private:
    SolidModel(std::shared_ptr<const SolidNumerics>          numerics,
               std::shared_ptr<const std::vector<Body<dim>>> bodies,
               const std::vector<bool>                      &kept,
               MPI_Comm                                      communicator);

    void
    distribute_dofs();
    void
    collect_nodes();
    std::vector<FixedDof>
    find_fixed() const;
    void
    collect_fixed();
    void
    make_sparsity();

    std::shared_ptr<const SolidNumerics>          solid_numerics;
    std::shared_ptr<const std::vector<Body<dim>>> all_bodies;
    std::vector<bool>                             kept; ///< [body]
    dealii::MappingQ<dim>                         straight;
    dealii::parallel::shared::Triangulation<dim>  mesh;
    std::vector<LoadedFace<dim>>                  loaded_faces;
    dealii::FESystem<dim>                         element;
    dealii::DoFHandler<dim>                       dofs;
    dealii::IndexSet                              relevant;
    dealii::IndexSet                              fixed_of_all_ranks;
    std::vector<FixedDof>                         owned_fixed;
    std::vector<unsigned int>                     axes;           ///< [dof]
    std::vector<dealii::Point<dim>>               rest_positions; ///< [dof]
    std::unique_ptr<const RestGeometry<dim>>      rest;
    dealii::TrilinosWrappers::SparsityPattern     sparsity;
  };
} // namespace undine

#endif
