// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_cutting_cut_flags_h
#define undine_cutting_cut_flags_h

namespace undine
{
  /// Errors of a cut cell, face or grid edge; any sum of these.
  enum CutFlag : unsigned int
  {
    cut_winding          = 1,   ///< a node that lies in two bodies, or in one that is inside out
    cut_loop             = 2,   ///< chords and fluid intervals do not close around a face
    cut_pairing          = 4,   ///< an edge that not exactly two parts of a cell share
    cut_nesting          = 8,   ///< a hole or island that nothing encloses
    cut_order            = 16,  ///< crossings in a wrong order by more than rounding
    cut_negative_area    = 32,  ///< by more than rounding
    cut_negative_volume  = 64,  ///< by more than rounding
    cut_closure          = 128, ///< open pieces and fragments do not close around a component
    cut_splitting_failed = 256  ///< a facet could not be split (not known to happen)
  };

  /// Flags after which a face or cell is sampled instead. Overlaps too small to hold a node of the
  /// grid are among them though closure would be exact: as fluid of negative volume they would
  /// receive the surface flux of moving bodies, through pieces as small as the overlap.
  constexpr unsigned int cut_needs_sampling = cut_winding | cut_loop | cut_pairing | cut_nesting |
                                              cut_order | cut_negative_area | cut_negative_volume |
                                              cut_closure;

  /// Relative levels at which things are reported; no topology depends on them. @{
  constexpr double reported_inversion = 1e-9;
  constexpr double reported_closure   = 1e-10;
  /// @}
} // namespace undine

#endif
