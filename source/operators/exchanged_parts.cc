// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/operators/exchanged_parts.h>

#include <algorithm>
#include <vector>

namespace undine
{
  namespace
  {
    /// Sub-cells and sub-faces at images of points are shifted along.
    template <int dim>
    void
    move_images(std::vector<typename SubLattice<dim>::Part> &parts, const Lattice<dim> &lattice)
    {
      for (auto &part : parts)
        {
          const auto point = lattice.wrapped(part.index);
          if (!(point == part.index))
            part.place += lattice.point(part.index) - lattice.point(point);
        }
    }
  } // namespace


  template <int dim>
  SubLattice<dim>
  make_exchanged_parts(
    const std::shared_ptr<const Lattice<dim>>                                        &lattice,
    Field<dim>                                                                        counts,
    const std::function<typename SubLattice<dim>::Part(const GridIndex<dim> &, int)> &part)
  {
    using Kind = typename SubLattice<dim>::Kind;
    using Part = typename SubLattice<dim>::Part;
    counts.exchange(1);
    const auto        box = known_points(*lattice);
    std::vector<Kind> kinds;
    std::vector<Part> parts;
    kinds.reserve(box.size());
    for_each_row(box, [&](const GridIndex<dim> &first, const int n) {
      const double *row = counts.data(first);
      for (int i = 0; i < n; ++i)
        {
          kinds.push_back(row[i] == count_whole    ? Kind::whole
                          : row[i] == count_closed ? Kind::closed
                                                   : Kind::divided);
          if (!(row[i] > 0))
            continue;
          const auto index = moved(first, 0, i);
          for (int k = 0; k < row[i]; ++k)
            parts.push_back(lattice->owned().contains(index) ? part(index, k) : Part{index, {}, 0});
        }
    });
    bool all_owned = lattice->blocks().n_ranks() == 1;
    for (unsigned int d = 0; d < dim; ++d)
      all_owned = all_owned && !lattice->row(d).periodic();
    if (all_owned)
      return SubLattice<dim>(lattice, kinds, parts);

    // What other ranks own is fetched from them by a first version that knows only who has what.
    const SubLattice<dim> numbered(lattice, kinds, parts);
    std::vector<double>   values(parts.size());
    const auto            fetch = [&](const auto &value) {
      for (std::size_t k = 0; k < parts.size(); ++k)
        values[k] = value(parts[k]);
      numbered.exchange(values);
      for (std::size_t k = 0; k < parts.size(); ++k)
        value(parts[k]) = values[k];
    };
    for (unsigned int d = 0; d < dim; ++d)
      fetch([d](auto &p) -> double & { return p.place[d]; });
    fetch([](auto &p) -> double & { return p.measure; });
    move_images<dim>(parts, *lattice);
    return SubLattice<dim>(lattice, kinds, parts);
  }


#define UNDINE_INSTANTIATE(dim)                  \
  template SubLattice<dim> make_exchanged_parts( \
    const std::shared_ptr<const Lattice<dim>> &, \
    Field<dim>,                                  \
    const std::function<typename SubLattice<dim>::Part(const GridIndex<dim> &, int)> &);

  UNDINE_INSTANTIATE(2)
  UNDINE_INSTANTIATE(3)
#undef UNDINE_INSTANTIATE
} // namespace undine
