// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_registry_h
#define undine_base_core_registry_h

#include <undine/base/core/errors.h>

#include <functional>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace undine
{
  /// The named parts of one kind (materials, effects, outputs, ...). A part adds itself by a
  /// namespace-scope Register object in its own .cc file; nothing else has to know it.
  template <class Part>
  class Registry
  {
    struct Entry;

  public:
    using Factory = std::function<std::unique_ptr<Part>()>;

    /// The registry of this kind of part. The only global objects of the program, apart from what
    /// signals and the end of memory set.
    static Registry &
    instance()
    {
      static Registry registry;
      return registry;
    }

    /// Throws std::logic_error if there is a part of that name.
    void
    add(const std::string &name, const std::string &help, Factory factory)
    {
      if (!entries.emplace(name, Entry{help, std::move(factory)}).second)
        throw std::logic_error("two parts of one kind are called '" + name + "'");
    }

    bool
    contains(const std::string &name) const
    {
      return entries.count(name) != 0;
    }

    /// A new part. Throws InputError with the registered names when `name` is not among them.
    std::unique_ptr<Part>
    make(const std::string &name) const
    {
      const auto entry = entries.find(name);
      if (entry == entries.end())
        throw InputError("there is no part named '" + name +
                         "'; the registered ones are: " + joined_names());
      return entry->second.factory();
    }

    /// While it lives, a part is as if it had never registered itself: for tests.
    class Hidden
    {
    public:
      Hidden(Registry &registry, const std::string &name)
        : registry(registry)
        , part(registry.entries.extract(name))
      {
      }

      ~Hidden()
      {
        registry.entries.insert(std::move(part));
      }

      Hidden(const Hidden &) = delete;
      Hidden &
      operator=(const Hidden &) = delete;

    private:
      Registry                                        &registry;
      typename std::map<std::string, Entry>::node_type part;
    };

    Hidden
    hide(const std::string &name)
    {
      return Hidden(*this, name);
    }

    const std::string &
    help(const std::string &name) const
    {
      return entries.at(name).help;
    }

    /// In alphabetical order.
    std::vector<std::string>
    names() const
    {
      std::vector<std::string> result;
      for (const auto &entry : entries)
        result.push_back(entry.first);
      return result;
    }

    std::string
    joined_names() const
    {
      std::string result;
      for (const auto &entry : entries)
        result += (result.empty() ? "" : " | ") + entry.first;
      return result;
    }

  private:
    struct Entry
    {
      std::string help;
      Factory     factory;
    };

    std::map<std::string, Entry> entries;
  };

  /// Adds `Concrete` to the registry of `Part` when it is constructed.
  template <class Part, class Concrete>
  struct Register
  {
    Register(const std::string &name, const std::string &help)
    {
      Registry<Part>::instance().add(name, help, [] { return std::make_unique<Concrete>(); });
    }
  };

  /// The same for parts that are templates over the dimension: registers them for 2 and 3.
  template <template <int> class Part, template <int> class Concrete>
  struct RegisterForDimensions
  {
    RegisterForDimensions(const std::string &name, const std::string &help)
      : two(name, help)
      , three(name, help)
    {
    }

    Register<Part<2>, Concrete<2>> two;
    Register<Part<3>, Concrete<3>> three;
  };
} // namespace undine

#endif
