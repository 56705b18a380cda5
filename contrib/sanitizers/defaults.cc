// SPDX-License-Identifier: LGPL-2.1-or-later
// What the sanitizers ask a program for when it starts: options, and files of what is not reported.
// Here and not in the environment of tests, so that it holds however a program is started, under
// mpirun too. Options in ASAN_OPTIONS, UBSAN_OPTIONS, LSAN_OPTIONS and TSAN_OPTIONS come before these.

extern "C" const char *
__asan_default_options()
{
  return "detect_stack_use_after_return=1:strict_string_checks=1:check_initialization_order=1";
}

extern "C" const char *
__lsan_default_options()
{
  return "print_suppressions=0:suppressions=" UNDINE_SANITIZERS "/lsan.supp";
}

extern "C" const char *
__ubsan_default_options()
{
  return "halt_on_error=1:print_stacktrace=1:suppressions=" UNDINE_SANITIZERS "/ubsan.supp";
}

extern "C" const char *
__tsan_default_options()
{
  return "print_suppressions=0:suppressions=" UNDINE_SANITIZERS "/tsan.supp";
}
