// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_options_options_h
#define undine_base_options_options_h

#include <undine/base/core/errors.h>
#include <undine/base/core/registry.h>
#include <undine/base/options/parameter_file.h>
#include <undine/base/options/values.h>

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace undine
{
  /// One section of the parameter file. A part declares, reads, checks and documents a parameter
  /// in one statement:
  ///
  ///     options.add("Density", density, "kg/m^3", Allowed::positive(), "Mass per volume at
  ///     rest.");
  ///
  /// which leaves the scene's value in `density`, or its initial value if the scene has none. The
  /// same statements list every parameter for `--reference` and `parameters.prm`. An Options is a
  /// light handle: copies refer to the same file.
  ///
  /// A mistake of the scene is thrown where it is found, or, after collecting(), noted: the
  /// variable then keeps its initial value, reading goes on, and throw_mistakes() reports all of
  /// them.
  class Options
  {
  public:
    /// What one statement said, with the value in use.
    struct Entry
    {
      std::string section; ///< "Bodies/beam/" or ""
      std::string key;
      std::string value;
      std::string default_value;
      std::string type;
      std::string unit;
      std::string allowed;
      std::string help;
      std::string condition; ///< "Model = neo-Hookean": known only then; empty: always
      bool        required = false;
    };

    /// Read from a file. Throws InputError if lines of it make no sense.
    explicit Options(ParameterFile file);

    /// Read from a file and note mistakes, those of its lines first, until throw_mistakes().
    static Options
    collecting(ParameterFile file);

    /// For documentation: add() changes nothing, choose() visits every registered part, and
    /// named_sections() returns one example name.
    static Options
    for_reference();

    bool
    is_reference() const;

    /// The subsection `name` of this section.
    Options
    section(const std::string &name) const;

    /// Declare and read one parameter. Throws InputError naming file, line, section, key and
    /// allowed values if the scene's value is not allowed.
    template <class Value>
    void
    add(const std::string &key,
        Value             &variable,
        const std::string &unit,
        const Allowed     &allowed,
        const std::string &help) const
    {
      const std::string before = write_value(variable);
      if (const auto *text = assigned_text(key))
        try
          {
            read_value(*text, allowed, variable);
          }
        catch (const InputError &reason)
          {
            mistake(error(key,
                          "the value '" + *text + "' " + reason.what(),
                          allowed_values(variable, unit, allowed)));
          }
      watch(key, variable);
      record({"",
              key,
              write_value(variable),
              before,
              type_text(variable, allowed),
              unit,
              allowed.description,
              help,
              "",
              false});
    }

    /// A parameter without a sensible default: the scene must give it.
    template <class Value>
    void
    require(const std::string &key,
            Value             &variable,
            const std::string &unit,
            const Allowed     &allowed,
            const std::string &help) const
    {
      if (!is_reference() && !given(key))
        mistake(error(key, "must be given", allowed_values(variable, unit, allowed) + ". " + help));
      add(key, variable, unit, allowed, help);
      mark_required(key);
    }

    /// Choose a registered part by name and let it add its own options to this section.
    template <class Part>
    std::unique_ptr<Part>
    choose(const std::string &key, const std::string &default_name, const std::string &help) const
    {
      const auto &registry = Registry<Part>::instance();
      std::string name     = default_name;
      add(key, name, "", Allowed::one_of(registry.names()), help);
      if (const auto *text = assigned_text(key); text != nullptr && *text != name)
        leave_unjudged(); // which keys the part would have is not known
      if (is_reference())
        {
          const std::string assignment = key + " = ";
          for (const auto &other : registry.names())
            registry.make(other)->add_options(under_condition(assignment + other));
        }
      auto part = registry.make(name);
      if (!is_reference())
        part->add_options(*this);
      return part;
    }

    /// True if the scene assigns this key; without one, if it assigns anything in this section or
    /// mentions one within it, even an empty one.
    bool
    given(const std::string &key = "") const;

    /// Names of subsections that the scene's author chose (bodies, probes, ...). A name that files
    /// of results could not hold is a mistake.
    std::vector<std::string>
    named_sections(const std::string &example_name) const;

    /// An error about `key` of this section; `what` continues "section 'S', key 'K': ...", `hint`
    /// says what is allowed or what to try.
    InputError
    error(const std::string &key, const std::string &what, const std::string &hint) const;

    /// Mistakes are assignments that no part has read: each with its place and the keys that exist
    /// there, the most similar one first. `sections_of_others` ("Bodies/", "Fluid/Boundaries/") are
    /// sections that this scene does not have, but could: what was meant may be one of them.
    void
    assert_all_used(const std::vector<std::string> &sections_of_others = {}) const;

    /// Run `action`, which reads this section, or the given subsections of it. If mistakes are
    /// collected, an InputError that it throws is noted, unless it may follow from others that the
    /// action has noted before; what it has not read there is then no mistake.
    template <class Action>
    void
    attempt(const Action &action, const std::vector<std::string> &subsections = {""}) const
    {
      const auto n_before = n_mistakes();
      try
        {
          action();
        }
      catch (const InputError &found)
        {
          if (!collects() || n_mistakes() == n_before)
            mistake(found);
          for (const auto &name : subsections)
            leave_unjudged(name);
        }
    }

    /// Note a mistake of the scene, or throw it if mistakes are not collected.
    void
    mistake(const InputError &found) const;

    /// `key`, or a subsection of that name, is no mistake even if no part reads it; if empty, all
    /// of this section.
    void
    leave_unjudged(const std::string &key = "") const;

    /// The number of mistakes noted so far.
    std::size_t
    n_mistakes() const;

    /// Throws InputError with all mistakes noted so far, if there are any.
    void
    throw_mistakes() const;

    /// Of expressions that had no finite value on this rank at `since` [s] or later: a sentence
    /// each, with section, key, place and time.
    std::vector<std::string>
    undefined_values(double since) const;

    const std::vector<Entry> &
    entries() const;

    const ParameterFile &
    file() const;

  private:
    /// An expression that the scene may have given.
    struct Watched
    {
      std::string section;
      std::string key;
      /// "(1, 0) and 0.3 s": where it had no finite value, if at that time [s] or later.
      std::function<std::string(double)> undefined_since;
    };

    struct Store
    {
      ParameterFile            file;
      bool                     reference = false;
      bool                     collects  = false;
      std::vector<Entry>       entries;
      std::vector<std::string> mistakes;
      std::vector<std::string> unjudged;          ///< sections in which any key may be right
      std::set<std::string>    sections_of_names; ///< whose subsections the scene names

      std::vector<Watched> watched; ///< see undefined_values()
    };

    Options() = default;

    /// "expression in x, y, t", without t where it must not be named.
    template <class Value>
    static std::string
    type_text(const Value &variable, const Allowed &allowed)
    {
      const std::string text = type_name(variable);
      return allowed.in_time ? text : text.substr(0, text.rfind(", t"));
    }

    /// "Allowed: number, > 0 [m]".
    template <class Value>
    static std::string
    allowed_values(const Value &variable, const std::string &unit, const Allowed &allowed)
    {
      return "Allowed: " + type_text(variable, allowed) +
             (allowed.description.empty() ? "" : ", " + allowed.description) +
             (unit.empty() ? "" : " [" + unit + "]");
    }

    const std::string *
    assigned_text(const std::string &key) const;

    /// See undefined_values(). @{
    template <class Value>
    void
    watch(const std::string &, const Value &) const
    {
    }

    template <int dim, int n_components>
    void
    watch(const std::string &key, const Expression<dim, n_components> &expression) const
    {
      store->watched.push_back({path, key, [expression](const double since) -> std::string {
                                  const auto undefined = expression.undefined_value();
                                  return undefined && undefined->time >= since ? undefined->text()
                                                                               : "";
                                }});
    }
    /// @}

    void
    record(Entry entry) const;

    void
    mark_required(const std::string &key) const;

    Options
    under_condition(const std::string &condition) const;

    InputError
    unknown(const std::string &full_path, const std::vector<std::string> &sections_of_others) const;

    bool
    collects() const;

    std::shared_ptr<Store> store;
    std::string            path; ///< "Bodies/beam/" or ""
    std::string            condition;
  };
} // namespace undine

#endif
