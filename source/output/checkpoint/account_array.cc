// SPDX-License-Identifier: LGPL-2.1-or-later
#include <undine/output/checkpoint/account_array.h>

#include <deal.II/base/mpi.h>

namespace undine
{
  StateArray
  pack_account(const EnergyAccount &account, const MPI_Comm communicator)
  {
    return numbers_of_first_rank(account_array,
                                 {account.energy,
                                  account.power,
                                  account.exchange,
                                  account.largest,
                                  account.created,
                                  account.excused,
                                  account.uncertain,
                                  account.known ? 1. : 0.,
                                  account.balance,
                                  account.level ? 1. : 0.,
                                  account.level.value_or(0.)},
                                 communicator);
  }


  EnergyAccount
  unpack_account(const StateArray &array, const MPI_Comm communicator)
  {
    const auto    numbers = dealii::Utilities::MPI::broadcast(communicator, array.values);
    EnergyAccount account;
    account.energy    = numbers[0];
    account.power     = numbers[1];
    account.exchange  = numbers[2];
    account.largest   = numbers[3];
    account.created   = numbers[4];
    account.excused   = numbers[5];
    account.uncertain = numbers[6];
    account.known     = numbers[7] != 0;
    account.balance   = numbers[8];
    if (numbers[9] != 0)
      account.level = numbers[10];
    return account;
  }
} // namespace undine
