// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_effects_transport_form_h
#define undine_effects_transport_form_h

#include <undine/base/options/options.h>

#include <algorithm>
#include <string>
#include <vector>

namespace undine
{
  /// Of an effect by which something moves with the flow: by fluxes through faces, or along paths
  /// by a `Method`. If the scene does not say, by fluxes where there is viscosity, no `Method` is
  /// given, and vorticity confinement makes up for no smoothing.
  class TransportForm
  {
  public:
    /// Declare the key `Form`. `what`: "convection", for messages; `help`: what each form means.
    /// It is a mistake to give a `Method` beside 'flux'.
    void
    add_options(const Options &options, const std::string &what, const std::string &help)
    {
      options.add("Form", form, "", Allowed::one_of({"automatic", "along paths", "flux"}), help);
      if (options.is_reference() || !options.given("Method"))
        return;
      if (form == "automatic")
        form = "along paths";
      if (form == "flux")
        options.mistake(options.error("Method",
                                      "is for " + what + " along paths, and the form is 'flux'",
                                      "Remove the key, or set 'Form = along paths'."));
    }

    /// The scene has these effects.
    void
    adapt_to(const std::vector<std::string> &effects)
    {
      const auto is_among = [&](const std::string &name) {
        return std::find(effects.begin(), effects.end(), name) != effects.end();
      };
      if (form == "automatic")
        form = is_among("viscosity") && !is_among("vorticity confinement") ? "flux" : "along paths";
    }

    bool
    is_flux() const
    {
      return form == "flux";
    }

  private:
    std::string form = "automatic";
  };
} // namespace undine

#endif
