// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_component_finder_h
#define undine_cutting_component_finder_h

#include <undine/cutting/cut_workspace.h>
#include <undine/cutting/part_sums.h>

#include <array>
#include <utility>
#include <vector>

namespace undine
{
  /// Finds the components of the fluid in the last of cut.cells. Its faces are known.
  ///
  /// find() appends components, fragments and their corners, sets the component on this side of the
  /// pieces of the cell's faces, and returns flags (CutFlag).
  template <int dim>
  class ComponentFinder;


  /// A component is a region of the planar problem of the cell.
  template <>
  class ComponentFinder<2>
  {
  public:
    unsigned int
    find(CutCells<2> &cut, CutWorkspace<2> &work, const PlacedSurface<2> &placed);

  private:
    void
    add_fragments(CutCells<2>            &cut,
                  const CutWorkspace<2>  &work,
                  const PlacedSurface<2> &placed,
                  const int               first_component) const;

    std::vector<PlanarEdge> edges; ///< of the cell: chords, then the sides' intervals
  };


  /// Fragments and pieces that share an edge bound the same component. Volumes by the divergence
  /// theorem. A closed shell inside the cell is an island in the component around it; like loops,
  /// shells of rounding size are never attached to anything.
  template <>
  class ComponentFinder<3>
  {
  public:
    unsigned int
    find(CutCells<3> &cut, CutWorkspace<3> &work, const PlacedSurface<3> &placed);

  private:
    /// What bounds the fluid in a cell: first its fragments, then the pieces of its six faces.
    struct Element
    {
      PartSums<3> sums;
      int         parent;           ///< in the union-find structure: the lowest element is the root
      bool        has_face = false; ///< a root with an open piece
      bool        debris   = false; ///< a root of rounding size without one
    };

    int
    root(int element);

    void
    add_fragments(CutCells<3> &cut, const CutWorkspace<3> &work, const PlacedSurface<3> &placed);

    void
    add_fragment(CutCells<3>                     &cut,
                 const CutWorkspace<3>           &work,
                 const PlacedSurface<3>          &placed,
                 const SplitSurface<3>::Fragment &fragment);

    void
    add_pieces(const CutCells<3> &cut, const CutWorkspace<3> &work);

    /// Join what shares edges, of which there are so many in all.
    unsigned int
    unite(const int n_edges);

    void
    sum_up(const CutCells<3> &cut, const CutWorkspace<3> &work);

    unsigned int
    attach_islands(const CutCells<3> &cut, const CutWorkspace<3> &work);

    /// The root around island `island`: what a ray in direction 0 from it meets; -1 if nothing.
    int
    surroundings(const CutCells<3> &cut, const CutWorkspace<3> &work, const int island);

    /// The element that a ray in direction 0 from `start` meets first with fluid in front; -1 if
    /// none.
    int
    first_fragment_hit(const CutCells<3>      &cut,
                       const CutWorkspace<3>  &work,
                       const dealii::Point<3> &start);

    void
    number_components(CutCells<3> &cut);

    dealii::Point<3>
    local(const SplitSurface<3>::Corner &corner, const CutWorkspace<3> &work) const;

    dealii::Point<3>     origin;    ///< lower corner of the cell [m]
    std::vector<int>     fragments; ///< of the cell, in split.fragments
    std::array<int, 6>   face_numbers;
    std::array<int, 7>   first_element; ///< of each face's pieces; and the number of all
    std::vector<Element> elements;
    std::vector<std::pair<int, int>> uses; ///< (edge number, element)

    /// The elements that use an edge in the cell.
    struct Users
    {
      int first  = -1; ///< element
      int n_uses = 0;
    };
    std::vector<Users> users; ///< by edge number, of all cells: none between one cell and the next

    std::vector<int> islands, targets, numbers;
  };
} // namespace undine

#endif
