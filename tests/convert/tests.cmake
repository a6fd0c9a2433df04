# Runs the command.
target_sources(${target} PRIVATE bad_input/run_program.cpp)
