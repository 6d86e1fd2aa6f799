# embed_text(VARIABLE files...) writes ${CMAKE_CURRENT_BINARY_DIR}/VARIABLE.cpp, which defines
# `extern const std::string_view umbsim::web::VARIABLE`: the files one after the other. Made again when one of them
# changes. Characters, not string literals: these have a length limit in the standard.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(EMBED_TEXT_SCRIPT ${CMAKE_CURRENT_LIST_FILE})
  function(embed_text variable)
    list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE inputs)
    list(JOIN inputs "|" joined)
    set(output ${CMAKE_CURRENT_BINARY_DIR}/${variable}.cpp)
    add_custom_command(
      OUTPUT ${output}
      COMMAND ${CMAKE_COMMAND} -DVARIABLE=${variable} -DINPUTS=${joined} -DOUTPUT=${output} -P ${EMBED_TEXT_SCRIPT}
      DEPENDS ${inputs} ${EMBED_TEXT_SCRIPT}
      COMMENT "Embedding ${variable}"
      VERBATIM)
  endfunction()
  return()
endif()

string(REPLACE "|" ";" INPUTS "${INPUTS}")
set(hex "")
foreach(input IN LISTS INPUTS)
  file(READ ${input} content HEX)
  string(APPEND hex "${content}")
endforeach()
string(REGEX REPLACE "([0-9a-f][0-9a-f])" "'\\\\x\\1'," characters "${hex}")
file(WRITE ${OUTPUT} "#include <string_view>

namespace umbsim::web {
static constexpr char kText[] = {${characters}};
extern const std::string_view ${VARIABLE};
const std::string_view ${VARIABLE}(kText, sizeof(kText));
}  // namespace umbsim::web
")
