// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_coupled_model_implied_effect_h
#define undine_coupled_model_implied_effect_h

#include <undine/coupled/model/models.h>

#include <string>
#include <vector>

namespace undine
{
  /// An effect that a scene calls for by what it is made of, its bodies, obstacles and materials,
  /// not by a subsection of `Effects`. It has no code of its own to switch: this tells of it, so
  /// that a run shows what it pays for. One file each that registers itself; its memory bears its
  /// name in TimingTree::memory.
  template <int dim>
  class ImpliedEffect
  {
  public:
    virtual ~ImpliedEffect() = default;

    /// Whether a scene calls for the effect.
    struct Call
    {
      bool        is_on;
      std::string why; ///< the sections and keys that call for it, or what is missing
    };

    /// Does the scene of these models call for the effect, and why?
    virtual Call
    call(const Models<dim> &models) const = 0;

    /// The phases of the timing in which it works.
    virtual std::vector<std::string>
    phases() const = 0;
  };

  /// "sheet, beam": the names of those bodies for which `holds(body)`.
  template <int dim, class Condition>
  std::string
  names_of_bodies(const Models<dim> &models, const Condition &holds)
  {
    std::string names;
    if (models.solid)
      for (const auto &body : models.solid->bodies())
        if (holds(body))
          names += (names.empty() ? "" : ", ") + body.name;
    return names;
  }
} // namespace undine

#endif
