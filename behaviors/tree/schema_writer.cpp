#include <string>

#include "behaviors/tree/registry.hpp"
#include "behaviors/tree/xml_text.hpp"

namespace swiftlet::tree {
namespace {

constexpr const char* kHead = R"(<?xml version="1.0" encoding="UTF-8"?>
<!-- Made from the node registry; a test fails when it is stale. Editors complete and check missions with it:
     <root BTCPP_format="4" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance" xsi:noNamespaceSchemaLocation="swiftlet.xsd"> -->
<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">
  <xs:element name="root">
    <xs:complexType>
      <xs:choice minOccurs="0" maxOccurs="unbounded">
        <xs:element name="include">
          <xs:complexType><xs:attribute name="path" type="xs:string" use="required"/></xs:complexType>
        </xs:element>
        <xs:element name="BehaviorTree">
          <xs:complexType>
            <xs:group ref="node"/>
            <xs:attribute name="ID" type="xs:string"/>
            <xs:attributeGroup ref="editor"/>
          </xs:complexType>
        </xs:element>
        <xs:element name="TreeNodesModel">
          <xs:complexType>
            <xs:sequence><xs:any minOccurs="0" maxOccurs="unbounded" processContents="skip"/></xs:sequence>
          </xs:complexType>
        </xs:element>
      </xs:choice>
      <xs:attribute name="BTCPP_format" use="required" fixed="4"/>
      <xs:attribute name="main_tree_to_execute" type="xs:string"/>
      <xs:attribute name="project_name" type="xs:string"/>
    </xs:complexType>
  </xs:element>

  <xs:attributeGroup name="editor">
    <xs:attribute name="name" type="xs:string"/>
    <xs:attribute name="_description" type="xs:string"/>
    <xs:attribute name="_uid" type="xs:string"/>
    <xs:attribute name="_fullpath" type="xs:string"/>
    <xs:attribute name="_fullPath" type="xs:string"/>
    <xs:attribute name="_failureIf" type="xs:string"/>
    <xs:attribute name="_successIf" type="xs:string"/>
    <xs:attribute name="_skipIf" type="xs:string"/>
    <xs:attribute name="_while" type="xs:string"/>
    <xs:attribute name="_onSuccess" type="xs:string"/>
    <xs:attribute name="_onFailure" type="xs:string"/>
    <xs:attribute name="_onHalted" type="xs:string"/>
    <xs:attribute name="_post" type="xs:string"/>
  </xs:attributeGroup>
  <xs:simpleType name="entry">
    <xs:restriction base="xs:string"><xs:pattern value="\{ *[^ {}]+( +[^ {}]+)* *\}"/></xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="boolean">
    <xs:restriction base="xs:string"><xs:pattern value=" *(true|True|TRUE|false|False|FALSE|0|1) *"/></xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="point">
    <xs:restriction base="xs:string">
      <xs:pattern value=" *-?[0-9.]+([eE][+\-]?[0-9]+)? *(; *-?[0-9.]+([eE][+\-]?[0-9]+)? *){1,2}"/>
    </xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="points">
    <xs:restriction base="xs:string"><xs:pattern value="[-+0-9.eE ;|]+"/></xs:restriction>
  </xs:simpleType>
  <xs:simpleType name="rectangle">
    <xs:restriction base="xs:string">
      <xs:pattern value=" *-?[0-9.]+([eE][+\-]?[0-9]+)? *(; *-?[0-9.]+([eE][+\-]?[0-9]+)? *){3}"/>
    </xs:restriction>
  </xs:simpleType>
)";

constexpr const char* kExplicit = R"(
  <xs:complexType name="explicit">
    <xs:group ref="node" minOccurs="0" maxOccurs="unbounded"/>
    <xs:attribute name="ID" type="xs:string" use="required"/>
    <xs:anyAttribute processContents="skip"/>
  </xs:complexType>
  <xs:complexType name="subtree">
    <xs:attribute name="ID" type="xs:string" use="required"/>
    <xs:attribute name="_autoremap" type="boolean"/>
    <xs:anyAttribute processContents="skip"/>
  </xs:complexType>
)";

std::string numberType(const PortManifest& port, const char* base) {
  std::string text = std::string("<xs:simpleType><xs:restriction base=\"") + base + "\">";
  if (port.minimum) text += "<xs:minInclusive value=\"" + toString(Value(*port.minimum)) + "\"/>";
  if (port.maximum) text += "<xs:maxInclusive value=\"" + toString(Value(*port.maximum)) + "\"/>";
  return text + "</xs:restriction></xs:simpleType>";
}

std::string enumerationOf(const std::vector<std::string>& texts) {
  std::string text = "<xs:simpleType><xs:restriction base=\"xs:string\">";
  for (const std::string& allowed : texts) text += "<xs:enumeration value=\"" + escaped(allowed) + "\"/>";
  return text + "</xs:restriction></xs:simpleType>";
}

/// A union of the values of the port and an entry `{x}`; empty for any text.
std::string typeOf(const PortManifest& port) {
  const auto withEntry = [](const std::string& members, const std::string& inner) {
    return "<xs:simpleType><xs:union memberTypes=\"" + members + "\">" + inner + "</xs:union></xs:simpleType>";
  };
  switch (port.type) {
    case PortType::kAny:
    case PortType::kString:
    case PortType::kScript:
      return allowedTexts(port).empty() ? std::string() : withEntry("entry", enumerationOf(allowedTexts(port)));
    case PortType::kBool:
      return withEntry("boolean entry", {});
    case PortType::kPoint:
      return withEntry("point entry", {});
    case PortType::kPoints:
      return withEntry("points entry", {});
    case PortType::kRectangle:
      return withEntry("rectangle entry", {});
    case PortType::kDouble:
    case PortType::kDuration:
      return withEntry("entry", numberType(port, "xs:double"));
    case PortType::kInt:
      return withEntry("entry", numberType(port, "xs:integer"));
  }
  return {};
}

void writeAttribute(const PortManifest& port, std::string& text) {
  const std::string type = typeOf(port);
  text += "      <xs:attribute name=\"" + escaped(port.name) + "\"";
  if (type.empty()) text += " type=\"xs:string\"";
  if (port.required) text += " use=\"required\"";
  if (port.default_value) text += " default=\"" + escaped(*port.default_value) + "\"";
  text += ">\n        <xs:annotation><xs:documentation>" + escaped(port.description) +
          "</xs:documentation></xs:annotation>\n";
  if (!type.empty()) text += "        " + type + "\n";
  text += "      </xs:attribute>\n";
}

/// Of the children of a control node.
std::string occurrences(const NodeManifest& manifest) {
  const std::string least = manifest.least_children ? std::to_string(*manifest.least_children) : "";
  return (least.empty() ? "" : " minOccurs=\"" + least + "\"") + " maxOccurs=\"" +
         (manifest.most_children ? std::to_string(*manifest.most_children) : "unbounded") + "\"";
}

void writeElement(const NodeManifest& manifest, std::string& text) {
  text += "  <xs:element name=\"" + escaped(manifest.id) + "\">\n    <xs:annotation><xs:documentation>" +
          escaped(manifest.description) + "</xs:documentation></xs:annotation>\n    <xs:complexType>\n";
  if (manifest.kind == NodeKind::kControl) text += "      <xs:group ref=\"node\"" + occurrences(manifest) + "/>\n";
  if (manifest.kind == NodeKind::kDecorator) text += "      <xs:group ref=\"node\"/>\n";
  for (const PortManifest& port : manifest.ports) writeAttribute(port, text);
  text += "      <xs:attributeGroup ref=\"editor\"/>\n    </xs:complexType>\n  </xs:element>\n";
}

}  // namespace

std::string writeSchema(const Registry& registry) {
  std::string text = kHead;
  text += "\n  <xs:group name=\"node\">\n    <xs:choice>\n";
  for (const auto& [id, type] : registry.types()) text += "      <xs:element ref=\"" + escaped(id) + "\"/>\n";
  for (const char* kind : {"Action", "Condition", "Control", "Decorator"})
    text += std::string("      <xs:element name=\"") + kind + "\" type=\"explicit\"/>\n";
  text += "      <xs:element name=\"SubTree\" type=\"subtree\"/>\n    </xs:choice>\n  </xs:group>\n";
  text += kExplicit;
  text += "\n";
  for (const auto& [id, type] : registry.types()) writeElement(type.manifest, text);
  return text + "</xs:schema>\n";
}

}  // namespace swiftlet::tree
