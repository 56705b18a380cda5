# SPDX-License-Identifier: LGPL-2.1-or-later
# What programs can check without running Undine: the sources' rules and the answers to bad scenes.

add_test(NAME sources/checks_find_faults
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/checks/test_checks.py)
add_test(NAME sources/include_direction
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_include_direction.py
                 ${PROJECT_SOURCE_DIR})
add_test(NAME sources/style
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_style.py
                 ${PROJECT_SOURCE_DIR})
add_test(NAME sources/documents
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_documents.py
                 ${PROJECT_SOURCE_DIR})
add_test(NAME sources/manual COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/test_manual.py)
add_test(NAME sources/tutorials_find_faults
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/test_tutorials.py)
add_test(NAME sources/release COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/test_release.py)
add_test(NAME long/manual COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/test_manual.py --make)
set_tests_properties(long/manual PROPERTIES LABELS long SKIP_RETURN_CODE 77 TIMEOUT 1800)
add_test(NAME sources/layout COMMAND ${PROJECT_SOURCE_DIR}/contrib/indent --check)

add_test(NAME malformed/scenes
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_malformed.py
                 $<TARGET_FILE:undine> ${CMAKE_CURRENT_SOURCE_DIR}/malformed)
set_tests_properties(malformed/scenes PROPERTIES TIMEOUT 600)

add_test(NAME runs/install
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_install.py ${PROJECT_BINARY_DIR})
set_tests_properties(runs/install PROPERTIES PROCESSORS 2 TIMEOUT 300)

add_test(NAME runs/splitting
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_splitting.py $<TARGET_FILE:undine>
                 ${PROJECT_SOURCE_DIR}/prm/jet_two_sheets_split_2d.prm)
set_tests_properties(runs/splitting PROPERTIES TIMEOUT 300)

add_test(NAME runs/time_integration
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_time_integration.py $<TARGET_FILE:undine>)
set_tests_properties(runs/time_integration PROPERTIES TIMEOUT 300)

# Scenes and runs that need more memory than there is, and frames that take long.
add_test(NAME runs/memory_limit
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_memory_limit.py $<TARGET_FILE:undine>
                 ${PROJECT_SOURCE_DIR}/prm)
set_tests_properties(runs/memory_limit PROPERTIES PROCESSORS 2 TIMEOUT 600)
add_test(NAME long/memory_limits
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_memory_limit.py $<TARGET_FILE:undine>
                 ${PROJECT_SOURCE_DIR}/prm --long)
set_tests_properties(long/memory_limits PROPERTIES PROCESSORS 2 LABELS long TIMEOUT 1800)
add_test(NAME runs/long_frame
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_long_frame.py $<TARGET_FILE:undine>
                 ${PROJECT_SOURCE_DIR}/prm/dam_break_particles.prm)
set_tests_properties(runs/long_frame PROPERTIES TIMEOUT 300)

# Tutorials: all that their pages say, in a short form; and as it is written, with what it takes.
file(GLOB pages CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/doc/tutorials/*.md)
list(FILTER pages EXCLUDE REGEX "/README\\.md$")
foreach(page ${pages})
  get_filename_component(name ${page} NAME_WE)
  set(command ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_tutorials.py ${PROJECT_BINARY_DIR} ${page})
  add_test(NAME tutorials/${name} COMMAND ${command})
  add_test(NAME long/tutorial_${name} COMMAND ${command} --full)
  set_tests_properties(tutorials/${name} PROPERTIES TIMEOUT 300)
  set_tests_properties(long/tutorial_${name} PROPERTIES LABELS long TIMEOUT 7200)
endforeach()

# Pictures need packages that the program does not: without them the test is skipped.
add_test(NAME contrib/render
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_render.py ${PROJECT_SOURCE_DIR}/contrib/render
                 $<TARGET_FILE:undine> ${PROJECT_SOURCE_DIR}/prm)
add_test(NAME contrib/rendering COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/test_rendering.py)
set_tests_properties(contrib/render contrib/rendering PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)

# Iterations of the simultaneous scheme's linear solver, as recorded.
foreach(ranks 1 2)
  add_test(NAME runs/iterations.mpirun=${ranks}
           COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_iterations.py
                   $<TARGET_FILE:undine> ${ranks})
  set_tests_properties(runs/iterations.mpirun=${ranks} PROPERTIES PROCESSORS ${ranks} TIMEOUT 300)
endforeach()

# What measures steps: over ranks, and by their parts.
add_test(NAME runs/cost_benchmarks
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_cost_benchmarks.py $<TARGET_FILE:undine>)
set_tests_properties(runs/cost_benchmarks PROPERTIES PROCESSORS 2 TIMEOUT 300)

add_test(NAME runs/summary
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_summary.py $<TARGET_FILE:undine>
                 ${PROJECT_SOURCE_DIR}/prm)
set_tests_properties(runs/summary PROPERTIES PROCESSORS 2 TIMEOUT 300)

add_test(NAME runs/certificate
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_certificate.py $<TARGET_FILE:undine>
                 ${PROJECT_SOURCE_DIR}/prm)
set_tests_properties(runs/certificate PROPERTIES TIMEOUT 300)

# Hard cases: every scene of prm/hard for a few steps of 1/30 and of 1/240 s, and to its end; what their heads say of time
# and size.
file(GLOB hard_cases CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/prm/hard/*.prm)
foreach(scene ${hard_cases})
  get_filename_component(name ${scene} NAME_WE)
  add_test(NAME runs/hard_cases.${name}
           COMMAND ${PROJECT_SOURCE_DIR}/benchmarks/hard_cases.py
                   $<TARGET_FILE:undine> --short --case ${name})
  add_test(NAME scenes/head_of_${name}
           COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/scene_costs.py $<TARGET_FILE:undine> ${scene} --check)
  set_tests_properties(runs/hard_cases.${name} scenes/head_of_${name} PROPERTIES TIMEOUT 300)
  add_test(NAME long/hard_cases.${name}
           COMMAND ${PROJECT_SOURCE_DIR}/benchmarks/hard_cases.py
                   $<TARGET_FILE:undine> --check --case ${name})
  set_tests_properties(long/hard_cases.${name} PROPERTIES LABELS long TIMEOUT 7200)
endforeach()

# Studies: their arithmetic, tiny ones of each kind, and those that are shipped.
add_test(NAME studies/arithmetic COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/test_study.py)
foreach(part kinds budgets mistakes accuracy shipped)
  add_test(NAME studies/${part}
           COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_study.py $<TARGET_FILE:undine>
                   ${CMAKE_CURRENT_SOURCE_DIR}/studies ${part})
  set_tests_properties(studies/${part} PROPERTIES TIMEOUT 300)
endforeach()
set_tests_properties(studies/kinds studies/budgets PROPERTIES PROCESSORS 2)

# Stopped by signals, and what a user is told then.
add_test(NAME runs/signals
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_signals.py $<TARGET_FILE:undine>
                 ${CMAKE_CURRENT_SOURCE_DIR}/resume/friction.prm)
set_tests_properties(runs/signals PROPERTIES PROCESSORS 2 TIMEOUT 300)

# What takes long is run by './undine test --long' only.
add_test(NAME long/kills
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/campaign/kills.py
                 $<TARGET_FILE:undine>)
set_tests_properties(long/kills PROPERTIES PROCESSORS 2 LABELS long TIMEOUT 7200)

# Spoilt scenes: a small sample of those that tests/fuzz/fuzz.py makes, and the tester itself.
add_test(NAME fuzz/tester
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/test_fuzz.py)
set_tests_properties(fuzz/tester PROPERTIES TIMEOUT 300)
add_test(NAME fuzz/sample
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/fuzz/fuzz.py
                 $<TARGET_FILE:undine> --cases 30 --run 3 --jobs 2 --limit 120)
set_tests_properties(fuzz/sample PROPERTIES PROCESSORS 2 TIMEOUT 1200)
add_test(NAME long/memory_coupled
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_memory.py
                 $<TARGET_FILE:undine> ${CMAKE_CURRENT_SOURCE_DIR}/resume/friction.prm
                 "Domain/Cells=24, 3" "Bodies/bar/Cells=8, 1" "Time/Step=1/40" "Output/Interval=1"
                 "Fluid/Boundaries/open/Pressure=2000*sin(5*t)")
add_test(NAME long/memory_obstacle
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_memory.py
                 $<TARGET_FILE:undine> ${CMAKE_CURRENT_SOURCE_DIR}/resume/paddle.prm
                 "Output/Interval=1")
add_test(NAME long/memory_particles
         COMMAND ${Python3_EXECUTABLE} -B ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_memory.py
                 $<TARGET_FILE:undine> ${PROJECT_SOURCE_DIR}/prm/jet_over_weir_particles.prm
                 "Particles/Spacing=0.03" "Output/Interval=1")
# Water that swings for ten periods, and full boxes: at rest for ten seconds, with a ball that sinks.
add_test(NAME long/swinging_tank
         COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/benchmarks/swinging_tank.py --check
                 --program $<TARGET_FILE:undine>)
add_test(NAME long/particle_acceptance
         COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/benchmarks/particle_acceptance.py
                 --rows rest sinking --check --program $<TARGET_FILE:undine>)
add_test(NAME runs/particle_acceptance
         COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/benchmarks/particle_acceptance.py
                 --short --rows rest sinking --check --program $<TARGET_FILE:undine>)
set_tests_properties(runs/particle_acceptance PROPERTIES TIMEOUT 300)
set_tests_properties(long/memory_coupled long/memory_obstacle long/memory_particles
  long/swinging_tank long/particle_acceptance PROPERTIES LABELS long TIMEOUT 3600)

# Pages about runs: by laws, and of whole runs in a browser, which is skipped where there is none.
add_test(NAME report/laws COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/test_report.py)
set_tests_properties(report/laws PROPERTIES TIMEOUT 300)
add_test(NAME report/pages
         COMMAND ${CMAKE_CURRENT_SOURCE_DIR}/checks/check_report.py $<TARGET_FILE:undine>
                 ${PROJECT_SOURCE_DIR}/prm)
set_tests_properties(report/pages PROPERTIES SKIP_RETURN_CODE 77 PROCESSORS 2 TIMEOUT 600)
