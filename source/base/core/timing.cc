// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/timing.h>

#include <algorithm>
#include <iomanip>
#include <ostream>

namespace undine
{
  namespace
  {
    TimingTree::Node *
    child(TimingTree::Node &parent, const std::string &name)
    {
      const auto found = std::find_if(parent.children.begin(),
                                      parent.children.end(),
                                      [&](const auto &node) { return node->name == name; });
      if (found != parent.children.end())
        return found->get();
      parent.children.push_back(std::make_unique<TimingTree::Node>());
      parent.children.back()->name   = name;
      parent.children.back()->parent = &parent;
      return parent.children.back().get();
    }


    void
    write_row(std::ostream &out, const TimingTree::Node &node, const int depth, const double whole)
    {
      out << std::left << std::setw(44) << std::string(2 * depth, ' ') + node.name << std::right
          << std::setw(10) << node.calls << std::setw(14) << std::fixed << std::setprecision(4)
          << node.seconds << std::setw(9) << std::setprecision(1)
          << (whole > 0 ? 100 * node.seconds / whole : 0.) << '\n';
      for (const auto &inner : node.children)
        write_row(out, *inner, depth + 1, node.seconds);
    }


    void
    add_work(TimingTree::Work &sum, const TimingTree::Node &node, const std::string &name)
    {
      if (node.name == name)
        {
          sum.seconds += node.seconds;
          sum.calls += node.calls;
          return;
        }
      for (const auto &inner : node.children)
        add_work(sum, *inner, name);
    }
  } // namespace


  TimingTree::Section::Section(TimingTree &tree, const std::string &name)
    : tree(tree)
    , start(std::chrono::steady_clock::now())
  {
    tree.current = child(*tree.current, name);
  }


  TimingTree::Section::~Section()
  {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    tree.current->seconds += passed.count();
    ++tree.current->calls;
    tree.current = tree.current->parent;
  }


  TimingTree::TimingTree()
    : current(&top)
  {
    top.name = "whole run";
  }


  TimingTree::Section
  TimingTree::section(const std::string &name)
  {
    return Section(*this, name);
  }


  void
  TimingTree::add(const std::string &name, const double seconds)
  {
    auto *phase = child(*current, name);
    phase->seconds += seconds;
    ++phase->calls;
  }


  const TimingTree::Node &
  TimingTree::root() const
  {
    return top;
  }


  TimingTree::Work
  TimingTree::work_of(const std::string &name) const
  {
    Work sum;
    for (const auto &node : top.children)
      add_work(sum, *node, name);
    return sum;
  }


  void
  TimingTree::write(std::ostream &out) const
  {
    out << "# phase                                          calls       seconds        %\n";
    double whole = 0;
    for (const auto &node : top.children)
      whole += node->seconds;
    for (const auto &node : top.children)
      write_row(out, *node, 0, whole);
  }
} // namespace undine
