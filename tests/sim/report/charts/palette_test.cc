#include "sim/report/charts/palette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace assay::report::palette_test {
namespace {

using Rgb = std::array<double, 3>;  // linear, 0 to 1

Rgb Linear(std::string_view colour) {
  Rgb rgb{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double c = std::stoi(std::string(colour.substr(1 + 2 * i, 2)), nullptr, 16) / 255.0;
    rgb[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
  }
  return rgb;
}

double Luminance(const Rgb& rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

// Returns the contrast ratio of WCAG 2.1.
double Contrast(std::string_view a, std::string_view b) {
  const double la = Luminance(Linear(a));
  const double lb = Luminance(Linear(b));
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

// A colour vision, as the rows of a matrix on linear RGB. The values are those of Machado, Oliveira
// and Fernandes (2009) for severity 1.
using Vision = std::array<Rgb, 3>;
constexpr std::array<Vision, 4> kVisions = {
    Vision{Rgb{1, 0, 0}, Rgb{0, 1, 0}, Rgb{0, 0, 1}},
    Vision{Rgb{0.152286, 1.052583, -0.204868}, Rgb{0.114503, 0.786281, 0.099216},
           Rgb{-0.003882, -0.048116, 1.051998}},  // protanopia
    Vision{Rgb{0.367322, 0.860646, -0.227968}, Rgb{0.280085, 0.672501, 0.047413},
           Rgb{-0.011820, 0.042940, 0.968881}},  // deuteranopia
    Vision{Rgb{1.255528, -0.076749, -0.178779}, Rgb{-0.078411, 0.930809, 0.147602},
           Rgb{0.004733, 0.691367, 0.303900}},  // tritanopia
};

// Returns the CIE 1976 L*a*b* coordinates of the colour that is perceived.
Rgb Lab(const Vision& vision, std::string_view colour) {
  const Rgb rgb = Linear(colour);
  Rgb seen{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double sum = vision[i][0] * rgb[0] + vision[i][1] * rgb[1] + vision[i][2] * rgb[2];
    seen[i] = std::min(1.0, std::max(0.0, sum));
  }
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
  const double x = f((0.4124564 * seen[0] + 0.3575761 * seen[1] + 0.1804375 * seen[2]) / 0.95047);
  const double y = f(0.2126729 * seen[0] + 0.7151522 * seen[1] + 0.0721750 * seen[2]);
  const double z = f((0.0193339 * seen[0] + 0.1191920 * seen[1] + 0.9503041 * seen[2]) / 1.08883);
  return {116 * y - 16, 500 * (x - y), 200 * (y - z)};
}

double Distance(const Rgb& a, const Rgb& b) {
  return std::sqrt(std::pow(a[0] - b[0], 2) + std::pow(a[1] - b[1], 2) + std::pow(a[2] - b[2], 2));
}

// A difference of 2.3 is just noticeable, and several times that is plain.
TEST(Palette, VerdictsAreToldApartByEveryEye) {
  constexpr std::array kVerdicts = {kContained, kWithinResolution, kInconclusive, kViolated,
                                    kNotClaimed};
  constexpr double kPlain = 15;
  for (const Vision& vision : kVisions) {
    for (const Colour& a : kVerdicts) {
      for (const Colour& b : kVerdicts) {
        if (a.name == b.name) continue;
        EXPECT_GT(Distance(Lab(vision, a.light), Lab(vision, b.light)), kPlain)
            << a.name << " " << b.name << " " << &vision - kVisions.data();
        EXPECT_GT(Distance(Lab(vision, a.dark), Lab(vision, b.dark)), kPlain)
            << a.name << " " << b.name << " dark " << &vision - kVisions.data();
      }
    }
  }
}

// WCAG 2.1, 1.4.11, demands a contrast of 3 to 1 for shapes with a meaning.
TEST(Palette, StandsOutFromTheGround) {
  for (const Colour& colour : kPalette) {
    EXPECT_GT(Contrast(colour.light, kLightGround), 3) << colour.name;
    EXPECT_GT(Contrast(colour.dark, kDarkGround), 3) << colour.name << " dark";
  }
}

}  // namespace
}  // namespace assay::report::palette_test
