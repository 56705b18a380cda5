// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/base/core/memory_accounts.h>

#include <algorithm>

namespace undine
{
  void
  MemoryAccounts::hold(const std::string &name, const std::size_t bytes)
  {
    auto &account = accounts[name];
    account.now   = bytes;
    account.peak  = std::max(account.peak, bytes);
  }


  void
  MemoryAccounts::hold_briefly(const std::string &name, const std::size_t bytes)
  {
    auto &account = accounts[name];
    account.peak  = std::max(account.peak, account.now + bytes);
  }


  MemoryAccounts::Account
  MemoryAccounts::of(const std::string &name) const
  {
    const auto found = accounts.find(name);
    return found == accounts.end() ? Account() : found->second;
  }
} // namespace undine
