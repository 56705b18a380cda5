// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_memory_accounts_h
#define undine_base_core_memory_accounts_h

#include <cstddef>
#include <map>
#include <string>

namespace undine
{
  /// Bytes on this rank that exist for somebody's sake, by name, as those say who allocate them.
  class MemoryAccounts
  {
  public:
    struct Account
    {
      std::size_t now  = 0; ///< [bytes]
      std::size_t peak = 0; ///< the most so far [bytes]
    };

    /// From now on `name` holds so much.
    void
    hold(const std::string &name, std::size_t bytes);

    /// `name` has for a while so much besides what it holds.
    void
    hold_briefly(const std::string &name, std::size_t bytes);

    /// Of nobody's, if `name` has never held anything.
    Account
    of(const std::string &name) const;

  private:
    std::map<std::string, Account> accounts;
  };
} // namespace undine

#endif
