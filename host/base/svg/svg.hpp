// A picture as SVG 1.1 text. Coordinates are pixels, x to the right, y down, written with one decimal.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace liana::svg {

// A place in the picture [px].
struct Pixel {
  double x = 0.0;
  double y = 0.0;
};

// How a shape looks: colours as SVG names or #rrggbb, "none" for nothing.
struct Look {
  std::string_view fill = "none";
  std::string_view stroke = "none";
  double width = 1.0;    // of the stroke [px]
  double opacity = 1.0;  // 0..1, of fill and stroke
  bool dashed = false;
};

// How text looks.
struct Lettering {
  double size = 13.0;                 // [px]
  std::string_view anchor = "start";  // start, middle or end of the text stands at the place given
  std::string_view colour = "#222222";
  bool bold = false;
  bool upwards = false;  // turned by a quarter, read from below
  bool halo = false;     // white rim, to stand on lines
};

// Collects shapes, later ones over earlier ones. The canvas is white.
class Svg {
 public:
  // Size of the canvas [px], and the title that viewers and screen readers show.
  Svg(double width, double height, std::string_view title);

  void rectangle(Pixel corner, double width, double height, const Look& look);
  void line(Pixel from, Pixel to, const Look& look);
  // Joined straight lines with round ends; nothing for fewer than two points.
  void polyline(const std::vector<Pixel>& points, const Look& look);
  void polygon(const std::vector<Pixel>& points, const Look& look);
  void circle(Pixel centre, double radius, const Look& look);
  // Many horizontal bars of one height and colour as one small element: x and width of each, y of its middle.
  struct Bar {
    Pixel from;
    double width = 0.0;
  };
  void bars(const std::vector<Bar>& bars, double height, std::string_view colour);
  void text(Pixel at, std::string_view words, const Lettering& lettering = {});

  // The whole document.
  std::string document() const;

 private:
  void add_look(const Look& look);
  void add_points(const std::vector<Pixel>& points);

  std::string head_;
  std::string body_;
};

// Text with &, <, > and " written as XML wants them; control characters other than line breaks become spaces.
std::string escaped(std::string_view text);

// A number with at most `decimals` decimals and no trailing zeros; "0" for what rounds to zero.
std::string short_number(double value, int decimals);

}  // namespace liana::svg
