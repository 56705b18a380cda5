// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_timing_h
#define undine_base_core_timing_h

#include <chrono>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

namespace undine
{
  /// Wall seconds by phase, as a tree: a section opened inside another becomes its child.
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

    /// One row per phase: indented name, calls, seconds, share of the parent in percent.
    void
    write(std::ostream &out) const;

  private:
    Node  top;
    Node *current;
  };
} // namespace undine

#endif
