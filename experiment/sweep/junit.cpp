#include "experiment/sweep/junit.h"

#include <fmt/format.h>
#include <tinyxml2.h>

namespace umbsim {
namespace {

std::string value_text(const Cell& value) {
  return is_number(value) ? text_of_cell(value) : std::string("no value");
}

void open_case(tinyxml2::XMLPrinter& xml, const std::string& suite, const std::string& what, const std::string& name) {
  xml.OpenElement("testcase");
  xml.PushAttribute("classname", (suite + "." + what).c_str());
  xml.PushAttribute("name", name.c_str());
}

void add_fault(tinyxml2::XMLPrinter& xml, const char* element, const std::string& message) {
  xml.OpenElement(element);
  xml.PushAttribute("message", message.c_str());
  xml.CloseElement();
}

void add_check(tinyxml2::XMLPrinter& xml, const std::string& suite, const Check& check) {
  const std::string expected = text_of_expectation(check.expectation);
  for (const Outcome& o : check.outcomes) {
    const std::string point = o.point < 0 ? o.label : fmt::format("point {}, {}", o.point, o.label);
    open_case(xml, suite, check.expectation.figure, fmt::format("{} ({})", expected, point));
    if (!o.met)
      add_fault(xml, "failure",
                fmt::format("{} = {}, expected {}", check.expectation.figure, value_text(o.value), expected));
    xml.CloseElement();
  }
}

}  // namespace

std::string junit_xml(const std::string& suite, const std::vector<Check>& checks,
                      const std::vector<FailedPoint>& failed) {
  std::int64_t tests = failed.empty() ? 1 : std::int64_t(failed.size()), failures = 0;
  for (const Check& c : checks) tests += std::int64_t(c.outcomes.size()), failures += c.unmet;
  tinyxml2::XMLPrinter xml;
  xml.PushHeader(false, true);
  xml.OpenElement("testsuites");
  xml.OpenElement("testsuite");
  xml.PushAttribute("name", suite.c_str());
  xml.PushAttribute("tests", tests);
  xml.PushAttribute("failures", failures);
  xml.PushAttribute("errors", std::int64_t(failed.size()));
  if (failed.empty()) {
    open_case(xml, suite, "driven", "every point was driven");
    xml.CloseElement();
  }
  for (const FailedPoint& f : failed) {
    open_case(xml, suite, "driven", fmt::format("point {}, {}", f.number, f.label));
    add_fault(xml, "error", f.error);
    xml.CloseElement();
  }
  for (const Check& c : checks) add_check(xml, suite, c);
  xml.CloseElement();
  xml.CloseElement();
  return xml.CStr();
}

}  // namespace umbsim
