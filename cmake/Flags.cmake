# Compiler flags of every target. -ffp-contract=off: the same bytes whatever the optimiser fuses.
add_library(umbsim_flags INTERFACE)
target_compile_options(umbsim_flags INTERFACE $<BUILD_INTERFACE:-Wall;-Wextra;-Wshadow;-Wnon-virtual-dtor>
                       -ffp-contract=off -fno-math-errno)
if(UMBSIM_WARNINGS_AS_ERRORS)
  target_compile_options(umbsim_flags INTERFACE $<BUILD_INTERFACE:-Werror>)
endif()
