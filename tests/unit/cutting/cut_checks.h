// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_tests_cutting_cut_checks_h
#define undine_tests_cutting_cut_checks_h

#include <undine/cutting/cut_block.h>
#include <undine/cutting/fragment_at_plane.h>

#include <cutting/configurations.h>

#include <memory>

namespace undine_tests
{
  using namespace undine;

  enum class Grid
  {
    unit,  ///< planes at whole numbers
    graded ///< distances 1/4 ... 3/2, many planes at multiples of 1/4, scaled and moved
  };


  template <int dim>
  using Planes = std::array<std::vector<double>, dim>;


  /// Planes for the box of the configurations. A graded grid is then stretched and moved along each
  /// axis, and the bodies with it, so that coordinates are no round numbers.
  template <int dim>
  struct Stretched
  {
    Planes<dim> planes;
    double      volume = 1; ///< by which volumes have grown
  };

  template <int dim>
  Stretched<dim>
  make_planes(Bodies<dim> &bodies, const Grid grid, Random &random)
  {
    Stretched<dim> result;
    auto          &planes = result.planes;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double end = box_cells<dim>()[d];
        double       at = 0, factor = 1, origin = 0;
        if (grid == Grid::graded)
          {
            factor = random.power(-2, 1);
            origin = random.between(-1, 0) * factor * end;
          }
        while (at < end)
          {
            const double steps[] = {.25, .5, .5, .75, 1, 1, 1.5, random.between(.3, 1.2)};
            planes[d].push_back(origin + factor * at);
            at += grid == Grid::unit ? 1 : steps[random.below(8)];
          }
        planes[d].push_back(origin + factor * end);
        for (auto &x : bodies.nodes)
          x[d] = origin + factor * x[d];
        result.volume *= factor;
      }
    return result;
  }


  template <int dim>
  IndexBox<dim>
  all_cells(const GridPlanes<dim> &planes)
  {
    IndexBox<dim> result;
    for (unsigned int d = 0; d < dim; ++d)
      result.upper[d] = planes.n_cells(d);
    return result;
  }


  template <int dim>
  CutCells<dim>
  cut_all(const Planes<dim>                     &planes,
          const Surface<dim>                    &surface,
          const std::vector<dealii::Point<dim>> &positions)
  {
    const auto        grid = std::make_shared<const GridPlanes<dim>>(planes);
    CutCells<dim>     cut(GridBlock<dim>(grid, all_cells(*grid), 0));
    CutWorkspace<dim> work;
    cut_block(cut, work, {surface, positions});
    return cut;
  }


  /// Sets joined by pairs.
  class Joined
  {
  public:
    explicit Joined(const int n)
      : parents(n)
    {
      for (int i = 0; i < n; ++i)
        parents[i] = i;
    }

    int
    operator()(int i)
    {
      while (parents[i] != i)
        i = parents[i] = parents[parents[i]];
      return i;
    }

    void
    join(const int a, const int b)
    {
      parents[(*this)(a)] = (*this)(b);
    }

  private:
    std::vector<int> parents;
  };


  /// Volumes of the connected parts of the fluid, ascending; those of rounding size left out.
  template <int dim>
  std::vector<double>
  fluid_regions(const CutCells<dim> &cut, const double negligible)
  {
    const int  n_components = cut.components.size();
    Joined     joined(n_components + cut.block.cells().size());
    const auto uncut = [&](const GridIndex<dim> &cell) {
      return n_components + static_cast<int>(cut.block.cells().position(cell));
    };
    const auto is_fluid = [&](const GridIndex<dim> &cell) {
      return cut.cut_cell(cell) < 0 && !cut.in_solid(cell);
    };
    for (const auto &piece : cut.pieces)
      {
        const auto &face = cut.faces[piece.face];
        int         sides[2];
        bool        inside = true;
        for (const int end : {0, 1})
          {
            sides[end] = piece.components[end] == cut.uncut
                           ? uncut(moved(face.index, face.axis, end - 1))
                           : piece.components[end];
            inside     = inside && sides[end] >= 0;
          }
        if (inside)
          joined.join(sides[0], sides[1]);
      }
    std::map<int, double> volumes;
    for_each(cut.block.cells(), [&](const GridIndex<dim> &cell) {
      if (!is_fluid(cell))
        return;
      for (unsigned int d = 0; d < dim; ++d)
        if (const auto next = moved(cell, d, 1); cut.block.cells().contains(next) && is_fluid(next))
          joined.join(uncut(cell), uncut(next));
    });
    for_each(cut.block.cells(), [&](const GridIndex<dim> &cell) {
      if (is_fluid(cell))
        volumes[joined(uncut(cell))] += cut.block.cell_volume(cell);
    });
    for (int c = 0; c < n_components; ++c)
      volumes[joined(c)] += cut.components[c].volume;
    std::vector<double> result;
    for (const auto &volume : volumes)
      if (volume.second > negligible)
        result.push_back(volume.second);
    std::sort(result.begin(), result.end());
    return result;
  }


  /// Worst defects of the identities that cut cells must fulfil, in units of a cell or a face.
  struct Defects
  {
    double closure  = 0; ///< sum a n + sum N of a component
    double halves   = 0; ///< the same of the lower halves of a component, across the axis
    double linear   = 0; ///< flux of a linear field minus its divergence times volume
    double volume   = 0; ///< of all fluid, in units of the box
    double moment   = 0; ///< first moments of all fluid, in units of the box
    double facets   = 0; ///< integrals of 1, f, f g over facets, in units of their area
    double smallest = 0; ///< most negative volume or area
    int    leaks    = 0; ///< components on both sides of a sheet without its rim in their cell
  };


  /// Closure, and the fluxes of v = G (x - centre of the cell), random G, out of every component.
  template <int dim>
  void
  check_components(Defects                               &defects,
                   const CutCells<dim>                   &cut,
                   const Surface<dim>                    &surface,
                   const std::vector<dealii::Point<dim>> &positions,
                   Random                                &random)
  {
    dealii::Tensor<2, dim> gradient;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        gradient[i][j] = random.between(-1, 1);
    std::vector<dealii::Tensor<1, dim>> closure(cut.components.size());
    std::vector<double>                 flux(cut.components.size(), 0.);
    std::vector<double>                 scale(cut.components.size(), 0.);
    const auto                          velocity = [&](const int c, const dealii::Point<dim> &x) {
      const auto            &cell = cut.cells[cut.components[c].cell].index;
      dealii::Tensor<1, dim> scaled; // in widths of the cell, so that all axes count alike
      for (unsigned int d = 0; d < dim; ++d)
        scaled[d] =
          (x[d] - cut.block.planes().position(d, cell[d])) / cut.block.planes().width(d, cell[d]);
      auto result = gradient * scaled;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] *= cut.block.planes().width(d, cell[d]);
      return result;
    };
    for (const auto &piece : cut.pieces)
      for (const int end : {0, 1})
        if (const int c = piece.components[end]; c >= 0)
          {
            const unsigned int axis = cut.faces[piece.face].axis;
            const double       area = end == 0 ? piece.area : -piece.area;
            closure[c][axis] += area;
            flux[c] += area * velocity(c, piece.centroid)[axis];
            defects.smallest = std::min(defects.smallest, piece.area);
          }
    for (const auto &fragment : cut.fragments)
      if (const int c = fragment.component; c >= 0)
        {
          closure[c] += fragment.area_vector;
          for (unsigned int k = 0; k < dim; ++k)
            flux[c] += fragment.mean[k] * fragment.area_vector *
                       velocity(c, positions[surface.facets()[fragment.facet][k]]);
        }
    for (std::size_t c = 0; c < cut.components.size(); ++c)
      {
        const auto  &cell   = cut.cells[cut.components[c].cell].index;
        const double volume = cut.block.cell_volume(cell);
        for (unsigned int d = 0; d < dim; ++d)
          defects.closure =
            std::max(defects.closure, std::abs(closure[c][d]) / cut.block.face_area(d, cell));
        defects.linear = std::max(
          defects.linear, std::abs(flux[c] - trace(gradient) * cut.components[c].volume) / volume);
        defects.smallest = std::min(defects.smallest, cut.components[c].volume / volume);
      }
  }


  /// Around the half of a component that is lower along an axis, halves of pieces and of fragments
  /// close in the other directions.
  template <int dim>
  void
  check_halves(Defects &defects, const CutCells<dim> &cut)
  {
    for (unsigned int axis = 0; axis < dim; ++axis)
      {
        std::vector<dealii::Tensor<1, dim>> closure(cut.components.size());
        for (const auto &piece : cut.pieces)
          for (const int end : {0, 1})
            if (const int c = piece.components[end]; c >= 0)
              closure[c][cut.faces[piece.face].axis] +=
                (end == 0 ? 1 : -1) * piece.shape.lower_half[axis];
        for (std::size_t f = 0; f < cut.fragments.size(); ++f)
          if (const int c = cut.fragments[f].component; c >= 0)
            {
              const auto  &cell   = cut.cells[cut.components[c].cell].index;
              const double middle = cut.block.planes().position(axis, cell[axis]) +
                                    cut.block.planes().width(axis, cell[axis]) / 2;
              const dealii::ArrayView<const dealii::Point<dim>> corners(
                cut.corners.points.data() + cut.corners.first[f],
                cut.corners.first[f + 1] - cut.corners.first[f]);
              closure[c] +=
                half_of_fragment(corners, axis, middle, false).share * cut.fragments[f].area_vector;
            }
        for (std::size_t c = 0; c < cut.components.size(); ++c)
          for (unsigned int d = 0; d < dim; ++d)
            if (d != axis)
              defects.halves =
                std::max(defects.halves,
                         std::abs(closure[c][d]) /
                           cut.block.face_area(d, cut.cells[cut.components[c].cell].index));
      }
  }


  /// Volume and first moments of all fluid against those of the uncut bodies.
  template <int dim>
  void
  check_volume(Defects                               &defects,
               const CutCells<dim>                   &cut,
               const Surface<dim>                    &surface,
               const std::vector<dealii::Point<dim>> &positions)
  {
    dealii::Point<dim>     middle;
    double                 box    = 1;
    const auto            &planes = cut.block.planes();
    dealii::Tensor<1, dim> size;
    for (unsigned int d = 0; d < dim; ++d)
      {
        const double lower = planes.position(d, 0), upper = planes.position(d, planes.n_cells(d));
        middle[d] = (lower + upper) / 2;
        size[d]   = upper - lower;
        box *= size[d];
      }
    long double                  volume = -box; // of fluid and bodies minus the box
    std::array<long double, dim> moment{};      // around the middle
    const auto                   add = [&](const double v, const dealii::Point<dim> &centre) {
      volume += v;
      for (unsigned int d = 0; d < dim; ++d)
        moment[d] += v * (centre[d] - middle[d]);
    };
    for (const auto &component : cut.components)
      add(component.volume, component.centroid);
    for_each(cut.block.cells(), [&](const GridIndex<dim> &cell) {
      if (cut.cut_cell(cell) >= 0 || cut.in_solid(cell))
        return;
      dealii::Point<dim> centre;
      for (unsigned int d = 0; d < dim; ++d)
        centre[d] = planes.position(d, cell[d]) + planes.width(d, cell[d]) / 2;
      add(cut.block.cell_volume(cell), centre);
    });
    for (unsigned int f = 0; f < surface.facets().size(); ++f)
      {
        const auto             normal = area_vector(surface, f, positions);
        dealii::Tensor<1, dim> sum, squares;
        for (const unsigned int node : surface.facets()[f])
          {
            const auto x = positions[node] - middle;
            sum += x;
            for (unsigned int d = 0; d < dim; ++d)
              squares[d] += x[d] * x[d];
          }
        volume += static_cast<long double>(normal * sum) / (dim * dim);
        for (unsigned int d = 0; d < dim; ++d)
          moment[d] += normal[d] * (sum[d] * sum[d] + squares[d]) / (dim * (dim + 1)) / 2;
      }
    defects.volume = std::max<double>(defects.volume, std::abs(volume) / box);
    for (unsigned int d = 0; d < dim; ++d)
      defects.moment = std::max<double>(defects.moment, std::abs(moment[d]) / box / size[d]);
  }


  /// Integrals over the fragments of each facet against those over the facet.
  template <int dim>
  void
  check_facets(Defects                               &defects,
               const CutCells<dim>                   &cut,
               const Surface<dim>                    &surface,
               const std::vector<dealii::Point<dim>> &positions)
  {
    using Vector = dealii::Tensor<1, dim>;
    std::vector<Vector>                                   areas(surface.facets().size());
    std::vector<std::array<Vector, dim>>                  means(areas.size());
    std::vector<std::array<std::array<Vector, dim>, dim>> products(areas.size());
    for (const auto &fragment : cut.fragments)
      {
        const auto &n = fragment.area_vector;
        areas[fragment.facet] += n;
        for (unsigned int i = 0; i < dim; ++i)
          {
            means[fragment.facet][i] += fragment.mean[i] * n;
            for (unsigned int j = 0; j < dim; ++j)
              products[fragment.facet][i][j] += fragment.product(i, j) * n;
          }
      }
    for (unsigned int f = 0; f < areas.size(); ++f)
      {
        const auto exact = -area_vector(surface, f, positions);
        double     size  = 0; // differences of coordinates carry their rounding
        for (unsigned int d = 0; d < dim; ++d)
          size = std::max(size, cut.block.face_area(d, cut.block.cells().lower));
        size              = std::max(size, exact.norm());
        const auto defect = [&](const Vector &v) {
          defects.facets = std::max(defects.facets, v.norm() / size);
        };
        defect(areas[f] - exact);
        for (unsigned int i = 0; i < dim; ++i)
          {
            defect(means[f][i] - exact / dim);
            for (unsigned int j = 0; j < dim; ++j)
              defect(products[f][i][j] - exact * (i == j ? 2. : 1.) / (dim * (dim + 1)));
          }
      }
  }


  /// Components that bound both sides of a sheet of which their cell does not hold the rim.
  template <int dim>
  void
  check_leaks(Defects &defects, const CutCells<dim> &cut, const Bodies<dim> &bodies)
  {
    for (int cell = 0; cell < static_cast<int>(cut.cells.size()); ++cell)
      {
        std::map<unsigned, bool>                     rims;  // by body
        std::map<std::pair<int, unsigned>, unsigned> sides; // by component and body
        for (int f = cut.cells[cell].first_fragment; f < cut.end_fragment(cell); ++f)
          {
            const auto &fragment = cut.fragments[f];
            const auto  body     = bodies.bodies[fragment.facet];
            const auto  part     = bodies.parts[fragment.facet];
            rims[body]           = rims[body] || part == Part::rim;
            if (fragment.component >= 0)
              sides[{fragment.component, body}] |= part == Part::lower   ? 1
                                                   : part == Part::upper ? 2
                                                                         : 0;
          }
        for (const auto &side : sides)
          if (side.second == 3 && !rims[side.first.second])
            ++defects.leaks;
      }
  }


  template <int dim>
  Defects
  check_cut(const CutCells<dim> &cut,
            const Bodies<dim>   &bodies,
            const Surface<dim>  &surface,
            Random              &random)
  {
    Defects result;
    check_components(result, cut, surface, bodies.nodes, random);
    check_halves(result, cut);
    bool inside = true;
    for (const auto &x : bodies.nodes)
      for (unsigned int d = 0; d < dim; ++d)
        {
          const auto &planes = cut.block.planes();
          inside =
            inside && x[d] > planes.position(d, 0) && x[d] < planes.position(d, planes.n_cells(d));
        }
    if (inside)
      {
        check_volume(result, cut, surface, bodies.nodes);
        check_facets(result, cut, surface, bodies.nodes);
      }
    check_leaks(result, cut, bodies);
    return result;
  }
} // namespace undine_tests

#endif
