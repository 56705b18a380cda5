# SPDX-License-Identifier: LGPL-2.1-or-later
# How the program and its Python parts are started: read by ./undine and by the installed bin/undine. These set
#   program        the program itself
#   python_parts   the folder in which Python finds the package `study`
# and define prepare(), which makes both ready, and fail MESSAGE.

# One thread a rank, also where root or more ranks than processors are used.
mpi_environment() {
  export OMP_NUM_THREADS="${OMP_NUM_THREADS:-1}"
  export OPENBLAS_NUM_THREADS="${OPENBLAS_NUM_THREADS:-1}"
  export OMPI_ALLOW_RUN_AS_ROOT=1
  export OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
  export OMPI_MCA_rmaps_base_oversubscribe=1
  export UNDINE_PYTHON_PARTS="$python_parts"
}

# run_on_ranks RANKS ARGUMENTS...
# Open MPI kills ranks one second after SIGINT or SIGTERM has reached mpirun, but only passes SIGUSR1
# on, and waits. So mpirun gets a session of its own, which Ctrl-C does not reach, and that signal.
run_on_ranks() {
  ranks=$1
  shift
  setsid mpirun -n "$ranks" "$program" "$@" &
  launcher=$!
  trap 'kill -USR1 "$launcher"' INT TERM HUP
  while status=0; wait "$launcher" || status=$?; [ "$status" -gt 128 ] && kill -0 "$launcher" 2>/dev/null; do
    : # a signal has interrupted the waiting
  done
  exit "$status"
}

# run_script MODULE ARGUMENTS...
run_script() {
  module=$1
  shift
  prepare
  mpi_environment
  export UNDINE_PROGRAM="$program" PYTHONPATH="$python_parts" PYTHONDONTWRITEBYTECODE=1
  export PYTHONSAFEPATH=1 # a user's own report.py in the current folder is not meant
  exec /usr/bin/python3 -m "$module" "$@"
}

# asks_for_accuracy ARGUMENTS...
asks_for_accuracy() {
  case " $* " in
    *' --accuracy '* | *' --accuracy='*) true ;;
    *) false ;;
  esac
}

# hand_over ARGUMENTS...   to a script in Python, to several ranks, or to the program
hand_over() {
  case $1 in
    study | report)
      run_script "$@"
      ;;
    -n)
      case ${2:-} in
        '' | *[!0-9]* | 0*) fail "-n needs a number of ranks: undine -n 4 SCENE.prm" ;;
      esac
      ranks=$2
      shift 2
      ! asks_for_accuracy "$@" || fail "--accuracy runs on one rank: leave out -n $ranks"
      prepare
      mpi_environment
      run_on_ranks "$ranks" "$@"
      ;;
    *)
      ! asks_for_accuracy "$@" || run_script study.accuracy "$@"
      prepare
      mpi_environment
      exec "$program" "$@"
      ;;
  esac
}
