// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_timing_h
#define undine_base_core_timing_h

#include <undine/base/core/memory_accounts.h>

#include <chrono>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace undine
{
  /// What a run costs. Wall seconds by phase, as a tree: a section opened inside another becomes
  /// its child; and memory by name. The phases of an effect bear its name wherever they are.
  class TimingTree
  {
  public:
    struct Node
    {
      std::string                        name;
      double                             seconds = 0;
      unsigned long                      calls   = 0;
      Node                              *parent  = nullptr;
      std::vector<std::unique_ptr<Node>> children;
    };

    /// Times from its construction to its destruction.
    class Section
    {
    public:
      Section(TimingTree &tree, const std::string &name);
      ~Section();
      Section(const Section &) = delete;
      Section &
      operator=(const Section &) = delete;

    private:
      TimingTree                           &tree;
      std::chrono::steady_clock::time_point start;
    };

    TimingTree();

    /// `const auto timed = timing.section("assemble");`
    Section
    section(const std::string &name);

    /// Add what was measured elsewhere to the phase `name` of the present section.
    void
    add(const std::string &name, const double seconds);

    const Node &
    root() const;

    struct Work
    {
      double        seconds = 0;
      unsigned long calls   = 0;
    };

    /// Of all phases of this name, but not of those within another one of them.
    Work
    work_of(const std::string &name) const;

    /// One row per phase: indented name, calls, seconds, share of the parent in percent.
    void
    write(std::ostream &out) const;

    MemoryAccounts memory;

  private:
    Node  top;
    Node *current;
  };
} // namespace undine

#endif
