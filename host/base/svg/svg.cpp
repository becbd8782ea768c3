#include "host/base/svg/svg.hpp"

#include <charconv>
#include <utility>

namespace liana::svg {
namespace {

std::string px(double value) { return short_number(value, 1); }

std::string attribute(std::string_view name, std::string_view value) {
  return " " + std::string(name) + "=\"" + std::string(value) + "\"";
}

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 && c != '\n' ? ' ' : c;
    }
  }
  return out;
}

std::string short_number(double value, int decimals) {
  char digits[400];  // the longest double has 309 digits before the point
  const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::fixed, decimals).ptr;
  std::string text(digits, end);
  if (text.find('.') != std::string::npos) {
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
  }
  return text == "-0" ? "0" : text;
}

Svg::Svg(double width, double height, std::string_view title) {
  head_ = "<svg xmlns=\"http://www.w3.org/2000/svg\"" + attribute("viewBox", "0 0 " + px(width) + " " + px(height)) +
          attribute("width", px(width)) + attribute("height", px(height)) +
          " font-family=\"DejaVu Sans, Arial, sans-serif\" stroke-linejoin=\"round\">\n<title>" + escaped(title) +
          "</title>\n";
  rectangle({0.0, 0.0}, width, height, {.fill = "white"});
}

void Svg::add_look(const Look& look) {
  body_ += attribute("fill", look.fill);
  if (look.stroke != "none") {
    body_ += attribute("stroke", look.stroke) + attribute("stroke-width", px(look.width));
    if (look.dashed) body_ += attribute("stroke-dasharray", "6 4");
  }
  if (look.opacity < 1.0) body_ += attribute("opacity", short_number(look.opacity, 2));
  body_ += "/>\n";
}

void Svg::add_points(const std::vector<Pixel>& points) {
  body_ += " points=\"";
  for (std::size_t i = 0; i < points.size(); ++i)
    body_ += (i == 0 ? "" : " ") + px(points[i].x) + "," + px(points[i].y);
  body_ += "\"";
}

void Svg::rectangle(Pixel corner, double width, double height, const Look& look) {
  body_ += "<rect" + attribute("x", px(corner.x)) + attribute("y", px(corner.y)) + attribute("width", px(width)) +
           attribute("height", px(height));
  add_look(look);
}

void Svg::line(Pixel from, Pixel to, const Look& look) {
  body_ += "<line" + attribute("x1", px(from.x)) + attribute("y1", px(from.y)) + attribute("x2", px(to.x)) +
           attribute("y2", px(to.y));
  add_look(look);
}

void Svg::polyline(const std::vector<Pixel>& points, const Look& look) {
  if (points.size() < 2) return;
  body_ += "<polyline stroke-linecap=\"round\"";
  add_points(points);
  add_look(look);
}

void Svg::polygon(const std::vector<Pixel>& points, const Look& look) {
  body_ += "<polygon";
  add_points(points);
  add_look(look);
}

void Svg::circle(Pixel centre, double radius, const Look& look) {
  body_ += "<circle" + attribute("cx", px(centre.x)) + attribute("cy", px(centre.y)) + attribute("r", px(radius));
  add_look(look);
}

void Svg::bars(const std::vector<Bar>& bars, double height, std::string_view colour) {
  if (bars.empty()) return;
  body_ += "<path shape-rendering=\"crispEdges\" fill=\"none\"" + attribute("stroke", colour) +
           attribute("stroke-width", px(height)) + " d=\"";
  for (const Bar& bar : bars) body_ += "M" + px(bar.from.x) + " " + px(bar.from.y) + "h" + px(bar.width);
  body_ += "\"/>\n";
}

void Svg::text(Pixel at, std::string_view words, const Lettering& lettering) {
  body_ += "<text" + attribute("x", px(at.x)) + attribute("y", px(at.y)) + attribute("font-size", px(lettering.size)) +
           attribute("fill", lettering.colour);
  if (lettering.anchor != "start") body_ += attribute("text-anchor", lettering.anchor);
  if (lettering.bold) body_ += attribute("font-weight", "bold");
  if (lettering.halo) body_ += " stroke=\"white\" stroke-width=\"4\" paint-order=\"stroke\"";
  if (lettering.upwards) body_ += attribute("transform", "rotate(-90 " + px(at.x) + " " + px(at.y) + ")");
  body_ += ">" + escaped(words) + "</text>\n";
}

std::string Svg::document() const { return head_ + body_ + "</svg>\n"; }

}  // namespace liana::svg
