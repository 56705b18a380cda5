// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/cutting/node_windings.h>

#include <deal.II/base/mpi.h>

namespace undine
{
  namespace
  {
    /// Call action(key of the first node, number of the line) for every line of nodes of axis 0.
    template <int dim, class Action>
    void
    for_each_line(const GridBlock<dim> &block, const Action &action)
    {
      const int          length = block.nodes().upper[0] - block.nodes().lower[0];
      const std::int64_t lines  = block.nodes().size() / length;
      for (std::int64_t line = 0; line < lines; ++line)
        action(line * length, line);
    }


    /// The ranks whose blocks differ along axis 0 only, in that order.
    template <int dim>
    class RowOfBlocks
    {
    public:
      explicit RowOfBlocks(const Blocks<dim> &blocks)
      {
        auto      block    = blocks.block_of_rank(blocks.rank());
        const int position = block[0];
        block[0]           = 0;
        const int ierr     = MPI_Comm_split(
          blocks.communicator(), blocks.rank_of_block(block), position, &communicator);
        AssertThrowMPI(ierr);
      }

      RowOfBlocks(const RowOfBlocks &) = delete;

      ~RowOfBlocks()
      {
        MPI_Comm_free(&communicator);
      }

      /// Sums over the lower ranks of the row.
      std::vector<int>
      sums_below(const std::vector<int> &values) const
      {
        std::vector<int> result(values.size(), 0);
        const int        ierr =
          MPI_Exscan(values.data(), result.data(), values.size(), MPI_INT, MPI_SUM, communicator);
        AssertThrowMPI(ierr);
        if (dealii::Utilities::MPI::this_mpi_process(communicator) == 0)
          result.assign(values.size(), 0); // undefined by the standard
        return result;
      }

    private:
      MPI_Comm communicator;
    };
  } // namespace


  template <int dim>
  void
  NodeWindings<dim>::reset(const GridBlock<dim> &block)
  {
    windings.assign(block.nodes().size(), 0);
  }


  template <int dim>
  void
  NodeWindings<dim>::accumulate(const GridBlock<dim> &block)
  {
    const int length = block.nodes().upper[0] - block.nodes().lower[0];
    for_each_line(block, [&](const std::int64_t first, const std::int64_t) {
      for (std::int64_t node = first + 1; node < first + length; ++node)
        windings[node] += windings[node - 1];
    });
  }


  template <int dim>
  void
  NodeWindings<dim>::add_lower_blocks(const GridBlock<dim> &block, const Blocks<dim> &blocks)
  {
    if (blocks.n_blocks()[0] == 1)
      return;
    const int length = block.nodes().upper[0] - block.nodes().lower[0];
    const int begin  = block.owned().lower[0] - block.nodes().lower[0];
    const int end    = block.owned().upper[0] - block.nodes().lower[0];

    // The block at the domain's side also counts what lies outside, below its first node.
    const bool       first_block = block.owned().lower[0] == 0;
    std::vector<int> crossings(block.nodes().size() / length);
    for_each_line(block, [&](const std::int64_t first, const std::int64_t line) {
      crossings[line] = windings[first + end] - (first_block ? 0 : windings[first + begin]);
    });
    const auto below = RowOfBlocks<dim>(blocks).sums_below(crossings);
    if (first_block)
      return;
    for_each_line(block, [&](const std::int64_t first, const std::int64_t line) {
      const int offset = below[line] - windings[first + begin];
      for (std::int64_t node = first; node < first + length; ++node)
        windings[node] += offset;
    });
  }


  template class NodeWindings<2>;
  template class NodeWindings<3>;
} // namespace undine
