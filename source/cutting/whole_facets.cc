// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/whole_facets.h>

namespace undine
{
  namespace
  {
    /// Barycentric coordinates L of the whole facet are the sum of l_k times those of the part's
    /// corners C_k, so that means of them and of their products follow from those of l.
    template <int dim>
    void
    refer_to(typename CutCells<dim>::Fragment &fragment, const FacetPart<dim> &part)
    {
      const auto of_part = fragment;
      fragment.facet     = part.facet;
      if (part.is_whole())
        return;
      fragment.mean.fill(0);
      fragment.products.fill(0);
      for (unsigned int k = 0; k < dim; ++k)
        {
          for (unsigned int i = 0; i < dim; ++i)
            fragment.mean[i] += of_part.mean[k] * part.corners[k][i];
          for (unsigned int l = 0; l < dim; ++l)
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = i + 1; j < dim; ++j)
                fragment.products[i + j - 1] +=
                  of_part.product(k, l) * part.corners[k][i] * part.corners[l][j];
        }
    }
  } // namespace


  template <int dim>
  void
  refer_to_whole_facets(CutCells<dim> &cut, const std::vector<FacetPart<dim>> &parts)
  {
    for (auto &fragment : cut.fragments)
      refer_to<dim>(fragment, parts[fragment.facet]);
  }


  template void
  refer_to_whole_facets(CutCells<2> &, const std::vector<FacetPart<2>> &);
  template void
  refer_to_whole_facets(CutCells<3> &, const std::vector<FacetPart<3>> &);
} // namespace undine
