# embed_file(VARIABLE FILE) writes ${CMAKE_CURRENT_BINARY_DIR}/VARIABLE.cpp, which defines
# `extern const std::string_view umbsim::web::VARIABLE`: the file as it is. Made again when the file changes. The assembler
# takes it in: a megabyte as characters or literals keeps a compiler busy for long.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(EMBED_FILE_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
  function(embed_file variable input)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${variable}.cpp)
    add_custom_command(
      OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -DVARIABLE=${variable} -DINPUT=${input} -DOUTPUT=${output} -P ${EMBED_FILE_SCRIPT}
      DEPENDS ${input} ${EMBED_FILE_SCRIPT}
      COMMENT "Embedding ${variable}"
      VERBATIM)
    set_property(SOURCE ${output} APPEND PROPERTY OBJECT_DEPENDS ${input})
  endfunction()
  return()
endif()

file(WRITE ${OUTPUT} "#include <cstddef>
#include <string_view>

asm(R\"(
.section .rodata
.balign 16
umbsim_${VARIABLE}_begin:
.incbin \"${INPUT}\"
umbsim_${VARIABLE}_end:
.byte 0
.previous
)\");

extern \"C\" {
extern const char umbsim_${VARIABLE}_begin[];
extern const char umbsim_${VARIABLE}_end[];
}

namespace umbsim::web {
extern const std::string_view ${VARIABLE};
const std::string_view ${VARIABLE}(umbsim_${VARIABLE}_begin, std::size_t(umbsim_${VARIABLE}_end - umbsim_${VARIABLE}_begin));
}  // namespace umbsim::web
")
