// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/compact_numbering.h>
#include <undine/operators/cut_topology.h>
#include <undine/operators/dual_volumes.h>
#include <undine/operators/exchanged_parts.h>

#include <algorithm>
#include <utility>

namespace undine
{
  namespace
  {
    template <int dim>
    using Kind = typename SubLattice<dim>::Kind;

    template <int dim>
    using Part = typename SubLattice<dim>::Part;


    /// One of the two halves of a face on a periodic side.
    struct Half
    {
      double volume    = 0;  ///< of the fluid on this side that moves with the face [m^dim]
      int    component = -1; ///< of FluidTopology::cells, or FluidTopology::whole
      bool   open      = false;
    };


    template <int dim>
    class PartsOfCut
    {
    public:
      PartsOfCut(const MacGrid<dim> &grid, const CutCells<dim> &cut, const VoidMask &voids)
        : grid(grid)
        , cut(cut)
        , voids(voids)
        , dual(dual_volumes(cut))
        , components(cut.components.size(), [&](const int c) { return !voids.holds_component(c); })
        , pieces(cut.pieces.size(), [&](const int p) { return holds_fluid(cut.pieces[p]); })
      {
      }

      CutTopology<dim>
      make()
      {
        auto parts = std::make_shared<FluidTopology<dim>>();
        open       = parts.get();
        make_cells();
        number_components();
        for (unsigned int axis = 0; axis < dim; ++axis)
          {
            find_upper_halves(axis);
            make_faces(axis);
          }
        result.open = parts;
        return result;
      }

    private:
      using Open = FluidTopology<dim>;

      void
      make_cells();

      void
      number_components();

      void
      find_upper_halves(const unsigned int axis);

      void
      make_faces(const unsigned int axis);

      void
      fetch_pieces(const unsigned int axis);

      Half
      upper_half(const GridIndex<dim> &cell) const;

      Half
      lower_half(const GridIndex<dim> &cell, const unsigned int axis) const;

      Field<dim>
      count_uncut(const std::shared_ptr<const Lattice<dim>> &lattice) const;

      int
      count_on_periodic_side(const GridIndex<dim> &face, const unsigned int axis) const;

      /// The components of a cut cell that are not void.
      dealii::ArrayView<const int>
      components_of(const int slot) const
      {
        return components.between(cut.cells[slot].first_component, cut.end_component(slot));
      }

      /// The pieces of a face that are not void.
      dealii::ArrayView<const int>
      pieces_of(const int slot) const
      {
        return pieces.between(cut.faces[slot].first_piece, cut.end_piece(slot));
      }

      bool
      holds_fluid(const typename CutCells<dim>::Piece &piece) const
      {
        for (const int c : piece.components)
          if (c >= 0 && voids.holds_component(c))
            return false;
        return true;
      }

      bool
      joins_periodic_sides(const GridIndex<dim> &face, const unsigned int axis) const
      {
        return grid.periodic(axis) && face[axis] == 0;
      }

      /// Half the volume of the cell.
      double
      half_volume(const GridIndex<dim> &cell) const
      {
        return grid.cell_volume(cell) / 2;
      }

      const MacGrid<dim>    &grid;
      const CutCells<dim>   &cut;
      const VoidMask        &voids;
      const DualVolumes<dim> dual;
      const CompactNumbering components, pieces; ///< those that are not void
      Open                  *open = nullptr;
      CutTopology<dim>       result;
      std::vector<double>    upper_halves; ///< of each component its Half::volume at the upper
                                           ///< periodic side; -1: does not touch it
    };


    /// count_whole or count_closed for all owned points, as if no cell were cut. A face is like the
    /// cell above it, or that below where there is none.
    template <int dim>
    Field<dim>
    PartsOfCut<dim>::count_uncut(const std::shared_ptr<const Lattice<dim>> &lattice) const
    {
      Field<dim> counts(lattice);
      const auto cells = grid.cells()->owned();
      for_each_row(counts.owned(), [&](const GridIndex<dim> &first, const int n) {
        auto cell = first;
        for (unsigned int d = 0; d < dim; ++d)
          cell[d] = std::min(cell[d], cells.upper[d] - 1);
        const auto key      = cut.block.key(cell);
        const auto position = cut.block.cells().position(cell);
        const int  last     = cells.upper[0] - 1 - cell[0];
        double    *row      = &counts(first);
        for (int i = 0; i < n; ++i)
          {
            const int  k         = std::min(i, last);
            const bool is_closed = cut.windings[key + k] != 0 || voids.holds_cell(position + k);
            row[i]               = is_closed ? count_closed : count_whole;
          }
      });
      return counts;
    }


    template <int dim>
    void
    PartsOfCut<dim>::make_cells()
    {
      auto counts = count_uncut(grid.cells());
      for (int slot = 0; slot < static_cast<int>(cut.cells.size()); ++slot)
        if (const auto &cell = cut.cells[slot].index; counts.owned().contains(cell))
          counts(cell) = components_of(slot).size();
      open->cells = make_exchanged_parts<dim>(
        grid.cells(), std::move(counts), [&](const GridIndex<dim> &cell, const int k) {
          const auto &component = cut.components[components_of(cut.cut_cell(cell))[k]];
          return Part<dim>{cell, component.centroid, component.volume};
        });
    }


    template <int dim>
    void
    PartsOfCut<dim>::number_components()
    {
      const auto &parts = open->cells.all();
      result.cut_components.assign(parts.size(), -1);
      result.open_components.assign(cut.components.size(), -1);
      for (std::size_t k = 0; k < parts.size(); ++k)
        {
          const auto cell = grid.cells()->wrapped(parts[k].index);
          if (!cut.block.cells().contains(cell))
            continue;
          const int c = components_of(cut.cut_cell(cell))[k - open->cells.first(parts[k].index)];
          result.cut_components[k] = c;
          if (cell == parts[k].index)
            result.open_components[c] = k;
        }
    }


    /// What owners of cells below upper periodic sides know, for the owners of the faces there.
    template <int dim>
    void
    PartsOfCut<dim>::find_upper_halves(const unsigned int axis)
    {
      if (!grid.periodic(axis))
        return;
      upper_halves.assign(open->cells.all().size(), -1.);
      const int last = grid.cells_along()[axis] - 1;
      for (int f = 0; f < static_cast<int>(cut.faces.size()); ++f)
        if (cut.faces[f].axis == axis && cut.faces[f].index[axis] == last + 1)
          for (int p = cut.faces[f].first_piece; p < cut.end_piece(f); ++p)
            if (const int c = cut.pieces[p].components[0]; c >= 0 && result.open_components[c] >= 0)
              upper_halves[result.open_components[c]] = dual.volumes[p];
      open->cells.exchange(upper_halves);
    }


    /// What lies below a face on a periodic side, in a cell that may be an image.
    template <int dim>
    Half
    PartsOfCut<dim>::upper_half(const GridIndex<dim> &cell) const
    {
      if (open->cells.kind(cell) == Kind<dim>::whole)
        return {half_volume(cell), Open::whole, true};
      for (int c = open->cells.first(cell); c < open->cells.last(cell); ++c)
        if (upper_halves[c] >= 0)
          return {upper_halves[c], c, true};
      return {};
    }


    /// What lies above it, in an owned cell.
    template <int dim>
    Half
    PartsOfCut<dim>::lower_half(const GridIndex<dim> &cell, const unsigned int axis) const
    {
      if (open->cells.kind(cell) == Kind<dim>::whole)
        return {half_volume(cell), Open::whole, true};
      const int f = cut.cut_face(axis, cell);
      if (f >= 0)
        for (int p = cut.faces[f].first_piece; p < cut.end_piece(f); ++p)
          if (const int c = cut.pieces[p].components[1]; c >= 0 && result.open_components[c] >= 0)
            return {dual.volumes[p], result.open_components[c], true};
      return {};
    }


    template <int dim>
    int
    PartsOfCut<dim>::count_on_periodic_side(const GridIndex<dim> &face,
                                            const unsigned int    axis) const
    {
      const auto below = moved(face, axis, -1);
      for (const auto &kinds : {std::make_pair(Kind<dim>::whole, count_whole),
                                std::make_pair(Kind<dim>::closed, count_closed)})
        if (open->cells.kind(face) == kinds.first && open->cells.kind(below) == kinds.first)
          return kinds.second;
      return upper_half(below).open && lower_half(face, axis).open ? 1 : 0;
    }


    template <int dim>
    void
    PartsOfCut<dim>::make_faces(const unsigned int axis)
    {
      const auto &lattice = grid.faces(axis);
      auto        counts  = count_uncut(lattice);
      for (int slot = 0; slot < static_cast<int>(cut.faces.size()); ++slot)
        if (const auto &face = cut.faces[slot].index;
            cut.faces[slot].axis == axis && counts.owned().contains(face))
          counts(face) = pieces_of(slot).size();
      auto side        = counts.owned();
      side.upper[axis] = std::min(side.upper[axis], grid.periodic(axis) ? 1 : 0);
      for_each(side, [&](const GridIndex<dim> &face) {
        counts(face) = count_on_periodic_side(face, axis);
      });
      open->faces[axis] = make_exchanged_parts<dim>(
        lattice, std::move(counts), [&](const GridIndex<dim> &face, const int k) {
          if (joins_periodic_sides(face, axis))
            return Part<dim>{face, lattice->point(face), grid.face_area(axis, face)};
          const auto &piece = cut.pieces[pieces_of(cut.cut_face(axis, face))[k]];
          return Part<dim>{face, piece.centroid, piece.area};
        });
      fetch_pieces(axis);
    }


    /// Volumes and components of the pieces of faces that have been made. A component travels as
    /// the number that it has in its cell.
    template <int dim>
    void
    PartsOfCut<dim>::fetch_pieces(const unsigned int axis)
    {
      const auto                        &faces = open->faces[axis];
      const auto                        &cells = open->cells;
      const std::size_t                  n     = faces.all().size();
      std::vector<double>                volumes(n);
      std::array<std::vector<double>, 2> components{{volumes, volumes}};
      result.cut_pieces[axis].assign(n, -1);
      for (std::size_t k = 0; k < n; ++k)
        {
          const auto &face = faces.all()[k].index;
          if (!faces.owns(k))
            continue;
          std::array<int, 2> joined;
          if (joins_periodic_sides(face, axis))
            {
              const auto below = upper_half(moved(face, axis, -1));
              const auto above = lower_half(face, axis);
              joined           = {{below.component, above.component}};
              volumes[k]       = below.volume + above.volume;
            }
          else
            {
              const int p = pieces_of(cut.cut_face(axis, face))[k - faces.first(face)];
              for (const int end : {0, 1})
                {
                  const int c = cut.pieces[p].components[end];
                  joined[end] = c >= 0           ? result.open_components[c]
                                : c == cut.uncut ? Open::whole
                                                 : Open::outside;
                }
              volumes[k]                 = dual.volumes[p];
              result.cut_pieces[axis][k] = p;
            }
          for (const int end : {0, 1})
            components[end][k] = joined[end] >= 0
                                   ? joined[end] - cells.first(cells.all()[joined[end]].index)
                                   : joined[end];
        }
      faces.exchange(volumes);
      for (auto &of_end : components)
        faces.exchange(of_end);

      const auto known = known_points(*grid.cells());
      for (std::size_t k = 0; k < n; ++k)
        {
          typename Open::Piece piece{volumes[k], {{Open::outside, Open::outside}}};
          for (const int end : {0, 1})
            {
              const auto cell   = moved(faces.all()[k].index, axis, end - 1);
              const int  number = static_cast<int>(components[end][k]);
              if (known.contains(cell))
                piece.components[end] = number >= 0 ? cells.first(cell) + number : number;
            }
          open->pieces[axis].push_back(piece);
        }
    }
  } // namespace


  template <int dim>
  std::vector<double>
  CutTopology<dim>::of_cut_cells(const std::vector<double> &values) const
  {
    std::vector<double> result(open_components.size(), 0.);
    for (std::size_t c = 0; c < result.size(); ++c)
      if (open_components[c] >= 0)
        result[c] = values[open_components[c]];
    return result;
  }


  template <int dim>
  std::vector<double>
  CutTopology<dim>::of_fluid_topology(const std::vector<double> &values) const
  {
    std::vector<double> result(cut_components.size(), 0.);
    for (std::size_t c = 0; c < result.size(); ++c)
      if (cut_components[c] >= 0)
        result[c] = values[cut_components[c]];
    return result;
  }


  template <int dim>
  CutTopology<dim>
  make_cut_topology(const MacGrid<dim> &grid, const CutCells<dim> &cut, const VoidMask &voids)
  {
    return PartsOfCut<dim>(grid, cut, voids).make();
  }


  template struct CutTopology<2>;
  template struct CutTopology<3>;
  template CutTopology<2>
  make_cut_topology(const MacGrid<2> &, const CutCells<2> &, const VoidMask &);
  template CutTopology<3>
  make_cut_topology(const MacGrid<3> &, const CutCells<3> &, const VoidMask &);
} // namespace undine
