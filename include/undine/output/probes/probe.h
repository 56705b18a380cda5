// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_output_probes_probe_h
#define undine_output_probes_probe_h

#include <undine/base/core/column.h>
#include <undine/base/options/options.h>
#include <undine/coupled/model/models.h>
#include <undine/coupled/state/state.h>

#include <string>

namespace undine
{
  /// A named measurement whose numbers become columns of `statistics`: a subsection of `Probes`
  /// with its kind. A new kind is one new .cc file that registers itself.
  template <int dim>
  class Probe
  {
  public:
    virtual ~Probe() = default;

    /// Declares and reads the keys of this kind of probe.
    virtual void
    add_options(const Options &options) = 0;

    /// Prepare the measurement; `name` and `options` are those of the probe's subsection. Throws
    /// InputError if what the probe measures does not exist. Collective.
    virtual void
    start(const std::string &name, const Options &options, const Models<dim> &models) = 0;

    /// Collective; the same on all ranks. The names of the columns begin with that of the probe.
    virtual Columns
    columns(const Models<dim> &models, const State<dim> &state) const = 0;
  };
} // namespace undine

#endif
