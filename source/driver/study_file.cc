// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/options/expression.h>
#include <undine/driver/study_file.h>

#include <boost/algorithm/string.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

namespace undine
{
  namespace
  {
    std::vector<std::string>
    split(const std::string &text, const char separator)
    {
      std::vector<std::string> parts;
      boost::algorithm::split(parts, text, [&](const char c) { return c == separator; });
      for (auto &part : parts)
        boost::algorithm::trim(part);
      return parts;
    }


    /// A key of the scene and its values in a study.
    struct Setting
    {
      std::string key; ///< "Time/Step"
      std::string values;
    };


    /// All assignments in the subsection 'Settings', whatever their keys: the scene knows them.
    std::vector<Setting>
    read_settings(const Options &options, const std::string &path, const std::string &help)
    {
      std::vector<Setting> result;
      const auto           settings = options.section("Settings");
      if (options.is_reference())
        {
          std::string value;
          settings.add("<Section/Key>", value, "", Allowed::anything(), help);
          return result;
        }
      const std::string prefix = path + "Settings/";
      for (const auto &full : options.file().paths())
        if (full.rfind(prefix, 0) == 0)
          {
            const std::string key     = full.substr(prefix.size());
            const auto        name    = key.rfind('/');
            Options           section = settings;
            if (name != std::string::npos)
              section = settings.section(key.substr(0, name));
            std::string value;
            section.add(key.substr(name == std::string::npos ? 0 : name + 1),
                        value,
                        "",
                        Allowed::anything(),
                        help);
            result.push_back({key, value});
          }
      return result;
    }


    /// The length that goes with a value: a step or a spacing is one, numbers of cells are the
    /// inverse of the first of them; nothing if the value is no number.
    std::optional<double>
    length_of(const std::string &value)
    {
      try
        {
          const auto parts  = split(value, ',');
          double     number = 0;
          read_value(parts.front(), Allowed::positive(), number);
          return parts.size() > 1 ? 1 / number : number;
        }
      catch (const InputError &)
        {
          return {};
        }
    }


    std::vector<double>
    lengths_of(const Setting &setting)
    {
      std::vector<double> lengths;
      for (const auto &value : split(setting.values, '|'))
        if (const auto length = length_of(value))
          lengths.push_back(*length);
        else
          return {};
      return lengths;
    }


    /// Numbers of a range rise or fall, and are the same for all keys, so that there are others
    /// between them.
    void
    check_range(const Options &options, const std::vector<Setting> &settings)
    {
      for (const auto &setting : settings)
        {
          const auto numbers = lengths_of(setting);
          const bool single  = setting.values.find(',') == std::string::npos;
          const bool rises   = std::is_sorted(numbers.begin(), numbers.end(), std::less_equal<>());
          const bool falls = std::is_sorted(numbers.begin(), numbers.end(), std::greater_equal<>());
          if (!single || numbers.size() < 2 || !(rises || falls) ||
              numbers != lengths_of(settings.front()))
            options.mistake(
              options.error("Settings/" + setting.key,
                            "a range needs two numbers or more that rise or fall, the same ones "
                            "for all of its keys",
                            "Allowed: numbers > 0 with '|' between them, such as '1/240 | 1/30'."));
        }
    }


    void
    check_lengths(const Options             &options,
                  const std::vector<double> &lengths,
                  const std::size_t          n_values)
    {
      if (lengths.size() != n_values)
        options.mistake(options.error(
          "Lengths",
          lengths.empty()
            ? std::string("the values are no numbers, so how much finer each is must be said")
            : fmt::format("has {} numbers, but there are {} values", lengths.size(), n_values),
          "Allowed: a number > 0 for each value, such as 'Lengths = 1, 0.5, 0.25'"));
      else if (std::adjacent_find(lengths.begin(), lengths.end(), std::less_equal<>()) !=
               lengths.end())
        options.mistake(options.error("Lengths",
                                      "values must become finer from left to right",
                                      "Order the values from coarse to fine."));
    }


    void
    read_names(const Options &options, const std::size_t n_values)
    {
      std::vector<std::string> names;
      options.add("Names",
                  names,
                  "",
                  Allowed::anything(),
                  "What the values are called in tables and plots; the values themselves if not "
                  "given.");
      if (!names.empty() && names.size() != n_values && n_values != 0)
        options.mistake(options.error(
          "Names",
          fmt::format("has {} names, but there are {} values", names.size(), n_values),
          "Give each value a name, with ',' between them."));
    }


    /// Something that is varied. Is it a range?
    bool
    read_variation(const Options &options, const std::string &path)
    {
      std::string kind = "refinement";
      options.add("Kind",
                  kind,
                  "",
                  Allowed::one_of({"refinement", "variant", "range"}),
                  "'refinement': values come closer to the truth from left to right; 'variant': "
                  "ways of computing the same, each a curve of its own; 'range': numbers along "
                  "which runs are stable or not: such a study makes a map of stability.");
      const auto  settings = read_settings(options,
                                          path,
                                          "Values of a key of the scene, with '|' between them. "
                                           "Several keys of one variation change together. An empty "
                                           "value: the scene is taken without the key; 'as is': "
                                           "other variations say what it is, of which later ones "
                                           "override earlier ones. Keys of the study itself: "
                                           "'Ranks', and how a quantity is evaluated, such as "
                                           "'Quantities/drag/Factor'.");
      std::size_t n_values = 0;
      for (const auto &setting : settings)
        {
          const auto n = split(setting.values, '|').size();
          if (n_values != 0 && n != n_values)
            options.mistake(options.error(
              "Settings/" + setting.key,
              fmt::format("has {} values, but another key of this variation {}", n, n_values),
              "Give each key of a variation as many values, with '|' between them."));
          n_values = n;
        }
      if (settings.empty() && !options.is_reference())
        options.mistake(options.error("",
                                      "says nothing that changes",
                                      "Add a subsection 'Settings' with keys of the scene, such as "
                                      "'set Time/Step = 1/20 | 1/40 | 1/80'."));
      read_names(options, n_values);
      std::vector<double> lengths;
      if (!settings.empty() && kind != "variant")
        lengths = lengths_of(settings.front());
      options.add("Lengths",
                  lengths,
                  "",
                  Allowed::positive(),
                  "Of a refinement: a length proportional to that of step or cells for each value, "
                  "for orders of convergence. If not given, the values of the first key, or, if "
                  "these are several numbers, one over the first of them.");
      if (kind == "refinement" && !settings.empty())
        check_lengths(options, lengths, n_values);
      if (kind == "range")
        check_range(options, settings);
      return kind == "range";
    }


    void
    read_window(const Options &options)
    {
      double       from = 0, until = 0;
      unsigned int periods = 0;
      std::string  period_of;
      options.add("From", from, "s", Allowed::not_negative(), "Rows before are left out.");
      options.add(
        "Until", until, "s", Allowed::not_negative(), "Rows after are left out; 0: none are.");
      options.add(
        "Periods",
        periods,
        "",
        Allowed::anything(),
        "Only the last whole periods, as many as this, each from one upward passage of the "
        "middle between the largest and the smallest value to the next; 0: the whole time.");
      options.add("Period of",
                  period_of,
                  "",
                  Allowed::anything(),
                  "The column whose passages bound the periods; the quantity itself if not given.");
    }


    /// Points between two corners at which a field is compared.
    void
    read_points(const Options &options, const std::string &field)
    {
      std::string         body;
      std::vector<double> lower, upper, points;
      options.add("Body",
                  body,
                  "",
                  Allowed::anything(),
                  "Of a field of a body: the body; points are those of the body at rest.");
      options.add("Lower corner", lower, "m", Allowed::anything(), "Of the box of points.");
      options.add("Upper corner", upper, "m", Allowed::anything(), "Of the box of points.");
      options.add("Points",
                  points,
                  "",
                  Allowed::between(1, 100),
                  "How many along each axis, evenly, half a distance from the box's sides.");
      if (field != "none" &&
          (lower.empty() || lower.size() != upper.size() || lower.size() != points.size()))
        options.mistake(options.error("Field",
                                      "needs a box of points",
                                      "Give 'Lower corner', 'Upper corner' and 'Points', each with "
                                      "as many numbers as the scene has dimensions."));
    }


    /// The reference as expressions, ';' between them.
    void
    check_expressions(const Options &options, const std::string &text)
    {
      try
        {
          for (const auto &expression : split(text, ';'))
            Expression<3>{expression};
        }
      catch (const InputError &reason)
        {
          options.mistake(options.error("Reference",
                                        std::string("the value '") + text + "' " + reason.what(),
                                        "Allowed: expressions in x, y, z, t, one for each "
                                        "component of the quantity, with ';' between them"));
        }
    }


    void
    read_reference(const Options &options)
    {
      std::string expression, file, column, time_column = "t";
      double      factor = 1, scale = 0;

      std::vector<std::string> row;
      options.add("Reference",
                  expression,
                  "",
                  Allowed::anything(),
                  "What is exact: an expression in t or, of a field, in x, y, z, t, with ';' "
                  "between components. Without it and a file: the finest runs of the study, "
                  "extrapolated.");
      options.add("Reference file",
                  file,
                  "",
                  Allowed::anything(),
                  "A CSV file with a line of names; lines that begin with # are comments.");
      options.add("Reference column", column, "", Allowed::anything(), "Its column.");
      options.add("Reference row",
                  row,
                  "",
                  Allowed::anything(),
                  "Its row: 'name = value' of one or more other columns, with ',' between them.");
      options.add("Reference times",
                  time_column,
                  "",
                  Allowed::anything(),
                  "Its column of times, for values over time.");
      options.add("Reference factor", factor, "", Allowed::anything(), "Of the file's values.");
      options.add("Scale",
                  scale,
                  "",
                  Allowed::not_negative(),
                  "Errors are relative to this; 0: to the reference, or to its norm.");
      if (!expression.empty())
        check_expressions(options, expression);
      if (!file.empty() && !expression.empty())
        options.mistake(
          options.error("Reference", "is given beside a 'Reference file'", "Remove one of them."));
      if (!file.empty() && column.empty())
        options.mistake(options.error("Reference column",
                                      "must be given with a 'Reference file'",
                                      "Name a column of the file."));
    }


    /// Which times the values belong to, or whether they are rates.
    void
    read_times(const Options &options)
    {
      double share = 1, over = 0;
      bool   rate = false;
      options.add("Rate",
                  rate,
                  "",
                  Allowed::anything(),
                  "The derivative in time of the sum is evaluated, at every row that of the "
                  "parabola through this and the rows before and after; at the first and the last "
                  "row that of the nearest parabola. Of an impulse it is a force of second order.");
      options.add("Rate over",
                  over,
                  "s",
                  Allowed::not_negative(),
                  "Instead the mean rate over this time around a row, the same for runs of all "
                  "steps, where there are rows so long before and after. 0: as above.");
      if (over > 0 && !rate)
        options.mistake(
          options.error("Rate over", "is given without 'Rate'", "Set 'Rate = true'."));
      options.add("Share of step",
                  share,
                  "1",
                  Allowed::between(0, 1),
                  "Which time of a step the values belong to: 1 its end, 0.5 its middle.");
      if (rate && share != 1)
        options.mistake(options.error("Share of step",
                                      "is given beside 'Rate', which belongs to the times of rows",
                                      "Remove one of them."));
    }


    void
    read_quantity(const Options &options)
    {
      std::string columns, field = "none", evaluate = "end", unit;
      double      factor = 1;
      options.add("Columns",
                  columns,
                  "",
                  Allowed::anything(),
                  "Of the file 'statistics', with ';' between them: their sum is evaluated.");
      options.add(
        "Field",
        field,
        "",
        Allowed::one_of({"none", "velocity", "pressure", "displacement", "body velocity"}),
        "Instead of columns: a field, evaluated at points and compared in the l2 norm "
        "over all of them.");
      if (!options.is_reference() && columns.empty() == (field == "none"))
        options.mistake(options.error(
          "Columns",
          columns.empty() ? "or 'Field' must be given" : "and 'Field' are both given",
          "Name columns as the header of the run's file 'statistics' has them, without units."));
      options.add("Factor", factor, "", Allowed::anything(), "By which the sum is multiplied.");
      options.add("Unit", unit, "", Allowed::anything(), "Of the result, for tables.");
      options.add(
        "Evaluate",
        evaluate,
        "",
        Allowed::one_of({"end",
                         "mean",
                         "largest",
                         "smallest",
                         "middle",
                         "amplitude",
                         "frequency",
                         "period",
                         "time of largest",
                         "over time"}),
        "The value at the end, the mean over time, the largest or smallest value, the "
        "middle between these two or half of their difference, the frequency or period of "
        "upward passages of the middle, when the value is largest, or all values over time, "
        "compared in the norm over time.");
      read_times(options);
      read_window(options);
      read_points(options, field);
      read_reference(options);
    }


    void
    read_runs(const Options &options)
    {
      unsigned int ranks  = 1;
      double       repeat = 2, limit = 0;
      std::string  cost = "core seconds", combine = "all";
      options.add("Ranks", ranks, "", Allowed::positive(), "MPI ranks of a run.");
      options.add("Repeat below",
                  repeat,
                  "s",
                  Allowed::not_negative(),
                  "Runs that take less are made three times: the median counts.");
      options.add("Limit",
                  limit,
                  "s",
                  Allowed::not_negative(),
                  "A run that takes longer is stopped and counts as failed; 0: none is.");
      options.add("Cost",
                  cost,
                  "",
                  Allowed::one_of({"core seconds", "wall seconds"}),
                  "What accuracy is paid with in plots and recommendations.");
      options.add("Combine",
                  combine,
                  "",
                  Allowed::one_of({"all", "one at a time"}),
                  "'all': every value of each variation with every one of the others; 'one at a "
                  "time': each refinement alone, from the first values of the others, for a budget "
                  "of errors.");
    }
  } // namespace


  void
  read_study(const Options &options)
  {
    std::string         title    = "Study", scene;
    double              boundary = 1.2;
    bool                foretold = false;
    std::vector<double> levels{0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001};
    options.add("Title", title, "", Allowed::anything(), "What the study shows.");
    options.require("Scene",
                    scene,
                    "",
                    Allowed::anything(),
                    "The scene's parameter file, from the folder of the study.");
    read_runs(options);
    options.add("Boundary within",
                boundary,
                "1",
                Allowed::between(1.001, 100),
                "Of ranges: between two values of the last range with different verdicts others "
                "are tried until they differ by this factor at most.");
    options.add("Linear theory",
                foretold,
                "",
                Allowed::anything(),
                "Of ranges: also find where linear theory foretells that time splitting begins to "
                "be unstable, for the integrators of 'Output / Stability of splitting', by runs of "
                "one short step.");
    options.add("Levels",
                levels,
                "1",
                Allowed::positive(),
                "Relative errors for each of which the cheapest settings are recommended.");
    read_settings(options,
                  "",
                  "Value of a key of the scene in all runs; empty: the scene is taken without the "
                  "key, which another integrator may not know, for example.");

    const auto   variations = options.section("Vary");
    const auto   names      = variations.named_sections("variation");
    unsigned int n_ranges   = 0;
    for (const auto &name : names)
      n_ranges += read_variation(variations.section(name), "Vary/" + name + "/");
    if (names.empty())
      options.mistake(options.error("Vary",
                                    "nothing is varied",
                                    "Add a subsection 'Vary' with a subsection for each thing that "
                                    "changes, such as 'subsection step'."));
    const auto quantities = options.section("Quantities");
    const auto wanted     = quantities.named_sections("quantity");
    for (const auto &name : wanted)
      read_quantity(quantities.section(name));
    if (wanted.empty() && n_ranges == 0)
      options.mistake(options.error("Quantities",
                                    "no quantity is named",
                                    "Add a subsection 'Quantities' with a subsection for each, "
                                    "such as 'subsection drag'."));
  }
} // namespace undine
