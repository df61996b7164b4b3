#include "ModuleDescription.h"
#include "sinew/Pipeline/Report.h"

#include <cctype>

namespace sinew {
namespace {

std::string escaped(const std::string& text) {
  std::string xml;
  for (const char c : text) switch (c) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '"':
        xml += "&quot;";
        break;
      default:
        xml += c;
    }
  return xml;
}

/// `edge-length` as people write it: `Edge length`.
std::string caption(std::string name) {
  for (char& c : name)
    if (c == '-') c = ' ';
  if (!name.empty()) name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(name[0])));
  return name;
}

/// Slicer's element for each type of target.
struct ElementName {
  std::string operator()(const bool*) const { return "boolean"; }
  std::string operator()(const int*) const { return "integer"; }
  std::string operator()(const std::int64_t*) const { return "integer"; }
  std::string operator()(const double*) const { return "double"; }
  std::string operator()(const std::vector<std::string>*) const { return "string-vector"; }
  template <typename Text>
  std::string operator()(const Text*) const {
    return "string";
  }
};

std::string elementName(const ModuleParameter& parameter) {
  if (!parameter.element.empty()) return parameter.element;
  const std::string name = std::visit(ElementName{}, parameter.option.target);
  return parameter.option.choices.empty() ? name : name + "-enumeration";
}

class Writer {
 public:
  void line(const std::string& text) { text_.append(depth_, ' ').append(text).append("\n"); }
  void open(const std::string& name, const std::string& attributes = {}) {
    line("<" + name + attributes + ">");
    depth_ += 2;
  }
  void close(const std::string& name) {
    depth_ -= 2;
    line("</" + name + ">");
  }
  void leaf(const std::string& name, const std::string& text) {
    line("<" + name + ">" + escaped(text) + "</" + name + ">");
  }
  std::string text() && { return std::move(text_); }

 private:
  std::string text_;
  std::size_t depth_ = 0;
};

void write(Writer& xml, const ModuleParameter& parameter, int& index) {
  const std::string name = longName(parameter.option), element = elementName(parameter);
  std::string attributes;
  for (const auto& [key, value] : parameter.attributes)
    attributes += " " + key + "=\"" + escaped(value) + "\"";
  xml.open(element, attributes);
  xml.leaf("name", parameter.name());
  if (parameter.positional())
    xml.leaf("index", std::to_string(index++));
  else if (!parameter.result())
    xml.leaf("longflag", name);
  xml.leaf("label", parameter.label.empty() ? caption(name) : parameter.label);
  xml.leaf("description", helpText(parameter.option, ListStyle::Commas));
  if (parameter.channel != ModuleParameter::Channel::None)
    xml.leaf("channel", parameter.channel == ModuleParameter::Channel::Input ? "input" : "output");
  const std::string standard = defaultText(parameter.option);
  if (!standard.empty() && parameter.element.empty()) xml.leaf("default", standard);
  for (const std::string& choice : parameter.option.choices) xml.leaf("element", choice);
  if (parameter.option.least) {
    xml.open("constraints");
    xml.leaf("minimum", std::to_string(static_cast<int>(*parameter.option.least)));
    xml.close("constraints");
  }
  xml.close(element);
}

}  // namespace

std::string toXml(const ModuleDescription& description) {
  Writer xml;
  xml.line("<?xml version=\"1.0\" encoding=\"utf-8\"?>");
  xml.open("executable");
  xml.leaf("category", description.category);
  xml.leaf("title", description.title);
  xml.leaf("description", description.description);
  xml.leaf("version", version());
  xml.leaf("license", "Apache-2.0");
  int index = 0;
  for (const ModuleGroup& group : description.groups) {
    xml.open("parameters", group.advanced ? " advanced=\"true\"" : "");
    xml.leaf("label", group.label);
    xml.leaf("description", group.description);
    for (const ModuleParameter& parameter : group.parameters) write(xml, parameter, index);
    xml.close("parameters");
  }
  xml.close("executable");
  return std::move(xml).text();
}

}  // namespace sinew
