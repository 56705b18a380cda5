// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_fluid_grid_mac_grid_h
#define undine_fluid_grid_mac_grid_h

#include <undine/base/options/options.h>
#include <undine/fluid/grid/lattice.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/point.h>

#include <array>
#include <memory>
#include <vector>

namespace undine
{
  /// A box cut into cells by planes normal to the axes, at equal or graded distances. Pressure and
  /// scalars sit in cell centres, velocities in the centres of the faces normal to them (marker and
  /// cell grid, Harlow & Welch 1965). With dim = 2 all areas and volumes are per unit depth.
  template <int dim>
  class MacGrid
  {
  public:
    using Planes = std::array<std::vector<double>, dim>;

    /// `planes` in ascending order [m]. Throws InputError if there are more ranks than the grid can
    /// be divided for.
    MacGrid(const MPI_Comm              communicator,
            const Planes               &planes,
            const std::array<bool, dim> periodic);

    MPI_Comm
    communicator() const;

    /// Cells in all.
    dealii::types::global_dof_index
    n_cells() const;

    /// Number of cells in each direction.
    const GridIndex<dim> &
    cells_along() const;

    /// Is the domain periodic along `axis`?
    bool
    periodic(const unsigned int axis) const;

    /// Corners of the domain [m]. @{
    const dealii::Point<dim> &
    lower() const;
    const dealii::Point<dim> &
    upper() const;
    /// @}

    /// The planes normal to `axis` [m]; one more than cells.
    const std::vector<double> &
    planes(const unsigned int axis) const;

    /// The lattice of the cell centres.
    const std::shared_ptr<const Lattice<dim>> &
    cells() const;

    /// The lattice of the centres of the faces normal to `axis`.
    const std::shared_ptr<const Lattice<dim>> &
    faces(const unsigned int axis) const;

    /// Width of cell `cell` along `axis` [m]; images allowed.
    double
    cell_width(const unsigned int axis, const int cell) const;

    /// Distance of the pressures on either side of plane `plane` [m]; on the boundary half the
    /// width of the cell.
    double
    dual_width(const unsigned int axis, const int plane) const;

    /// [m^dim]
    double
    cell_volume(const GridIndex<dim> &cell) const;

    /// Area a_f of a face normal to `axis` [m^(dim-1)].
    double
    face_area(const unsigned int axis, const GridIndex<dim> &face) const;

    /// The widths along the first direction of the cells that follow each other from `first` on,
    /// and the areas of `n` faces [m^(dim-1)]. @{
    std::vector<double>
    cell_widths(const int first, const int n) const;

    void
    set_face_areas(std::vector<double>       &areas,
                   const unsigned int         axis,
                   const GridIndex<dim>      &first,
                   const std::vector<double> &widths) const;
    /// @}

    /// Volume V_f = a_f times dual_width() of a face [m^dim].
    double
    dual_volume(const unsigned int axis, const GridIndex<dim> &face) const;

    /// True for the first and last faces normal to `axis`, unless they are periodic.
    bool
    at_boundary(const unsigned int axis, const GridIndex<dim> &face) const;

    /// The cell that contains a place in the domain; a place outside counts as the nearest inside.
    GridIndex<dim>
    cell_at(const dealii::Point<dim> &place) const;

    /// How many planes normal to each direction d a segment of the extent `distance[d]` [m] crosses
    /// at most.
    GridIndex<dim>
    planes_crossed(const dealii::Tensor<1, dim> &distance) const;

  private:
    Planes                                               plane_positions;
    dealii::Point<dim>                                   lower_corner, upper_corner;
    std::shared_ptr<const Blocks<dim>>                   blocks;
    std::shared_ptr<const Lattice<dim>>                  cell_lattice;
    std::array<std::shared_ptr<const Lattice<dim>>, dim> face_lattices;
  };

  /// Read the positions of the planes [m] from section `Domain`: corners and numbers of cells,
  /// optionally graded, or the planes themselves. Throws InputError.
  template <int dim>
  typename MacGrid<dim>::Planes
  read_planes(const Options &domain);
} // namespace undine

#endif
