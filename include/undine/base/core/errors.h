// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef undine_base_core_errors_h
#define undine_base_core_errors_h

#include <stdexcept>
#include <string>

namespace undine
{
  /// Something went wrong that the user can act upon. what() says what happened, where, and what
  /// to try; the program prints it and exits with exit_code().
  class Error : public std::runtime_error
  {
  public:
    using std::runtime_error::runtime_error;

    virtual int
    exit_code() const
    {
      return 1;
    }
  };

  /// The scene is wrong: names file, section, key, allowed values.
  class InputError : public Error
  {
  public:
    using Error::Error;

    int
    exit_code() const override
    {
      return 2;
    }
  };

  /// A step could not be completed (no convergence, inverted element, not-a-number). The scheme
  /// may cut the step and try again from the saved state; if it cannot, the run fails.
  class SolveError : public Error
  {
  public:
    using Error::Error;

    int
    exit_code() const override
    {
      return 3;
    }
  };

  /// A file could not be written or read.
  class FileError : public Error
  {
  public:
    using Error::Error;

    int
    exit_code() const override
    {
      return 4;
    }
  };
} // namespace undine

#endif
