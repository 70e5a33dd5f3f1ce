// Bonding patterns that are given place by place: expressions with their area
// means over elements, the orientation of images, values from CSV files, what
// is said of those that are wrong, and all of it on the faces of implants in a
// bore.

#include <debond/bulk/bulk_space.h>
#include <debond/interface/bonding_pattern.h>
#include <debond/interface/bonding_source.h>
#include <debond/scene/scene.h>
#include <debond/support/input_error.h>

#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "checks.h"
#include "coin_scene.h"
#include "png_file.h"

using namespace Debond;

const double R = 2.5;

// of radius 2.5 mm
BodyParameters
coin(const unsigned int n)
{
  BodyParameters implant;
  implant.shape = BodyShape::coin;
  implant.cells = {{n, n, 2}};
  return implant;
}



BondingPattern
make_pattern(const BondingParameters &parameters, const BodyParameters &implant)
{
  // the pattern refers to the surface
  static std::vector<std::unique_ptr<NurbsSurface>> surfaces;
  surfaces.push_back(
    std::make_unique<NurbsSurface>(make_contact_surface(implant)));
  return {parameters, implant, *surfaces.back(), dealii::QGauss<1>(3)};
}



BondingParameters
expression(const std::string      &text,
           const BondingResolution resolution = BondingResolution::element)
{
  BondingParameters parameters;
  parameters.pattern    = BondingPatternKind::expression;
  parameters.expression = text;
  parameters.resolution = resolution;
  return parameters;
}



BondingParameters
from_file(const BondingPatternKind kind,
          const std::string       &name,
          const std::string       &content,
          const BondingResolution  resolution = BondingResolution::element)
{
  std::ofstream(name, std::ios::binary) << content;
  BondingParameters parameters;
  parameters.pattern    = kind;
  parameters.file       = name;
  parameters.resolution = resolution;
  return parameters;
}



// Integrals over the disk in closed form.
void
check_means()
{
  const auto mean = [](const std::string &text) {
    return make_pattern(expression(text), coin(6)).report().mean;
  };
  std::cout << "Expressions" << std::endl;
  report("  r^2/R^2, deviation of the mean",
         std::abs(mean("r^2/R^2") - 0.5),
         1e-8);
  report("  (x/R + 1)/2, deviation of the mean",
         std::abs(mean("(x/R + 1)/2") - 0.5),
         1e-12);
  report("  1 - r/R, deviation of the mean",
         std::abs(mean("1 - r/R") - 1. / 3.),
         1e-6);
  report("  a quarter by angle, deviation of the mean",
         std::abs(mean("angle > 0 && angle < 90") - 0.25),
         1e-12);
  // where the quarter is
  const auto quarter =
    make_pattern(expression("angle > 0 && angle < 90"), coin(6));
  for (const auto &part : quarter.parts())
    if (part.phi_0 != (part.centre[0] > 0 && part.centre[1] > 0 ? 1. : 0.))
      std::cout << "  NO, the quarter is elsewhere" << std::endl;
  report("  angle in degrees, deviation of the mean",
         std::abs(mean("angle/360 + 0.5") - 0.5),
         1e-12);
  report("  the largest angle is 180",
         make_pattern(expression("angle > 179",
                                 BondingResolution::quadrature_point),
                      coin(20))
             .report()
             .mean > 0.);
  BondingParameters half = expression("x > 0");
  half.initial_bonding   = 0.6;
  report("  Bonding degree multiplies, deviation of the mean",
         std::abs(make_pattern(half, coin(6)).report().mean - 0.3),
         1e-12);
  report("  r < R/2, deviation of the mean",
         std::abs(mean("r < R/2") - 0.25),
         1e-3); // quadrature of a jump

  // the mean over an element, with a fine quadrature of its own
  const BodyParameters implant = coin(3);
  const NurbsSurface   surface = make_contact_surface(implant);
  const auto           pattern =
    make_pattern(expression("0.5 + 0.2 * x * y / r"), implant);
  std::vector<double> sum(9), area(9);
  for (const auto &point : surface_quadrature(surface, dealii::QGauss<1>(40)))
    {
      sum[point.element] += point.JxW * (0.5 + 0.2 * point.X[0] * point.X[1] /
                                                 point.X.head<2>().norm());
      area[point.element] += point.JxW;
    }
  double largest = 0.;
  for (unsigned int e = 0; e < 9; ++e)
    grow(largest, std::abs(pattern.parts()[e].phi_0 - sum[e] / area[e]));
  report("  means of elements, deviation", largest, 1e-5);

  const auto by_point =
    make_pattern(expression("0.5 + 0.2 * x * y / r",
                            BondingResolution::quadrature_point),
                 implant);
  const auto points = surface_quadrature(surface, dealii::QGauss<1>(3));
  largest           = 0.;
  for (unsigned int q = 0; q < points.size(); ++q)
    grow(largest,
         std::abs(by_point.at(q) - 0.5 -
                  0.2 * points[q].X[0] * points[q].X[1] /
                    points[q].X.head<2>().norm()));
  report("  values at quadrature points, deviation", largest, 1e-14);

  report(
    "  two patches",
    make_pattern(expression("abs(x) > 0.3 * R"), coin(20)).report().patches ==
      2);
  report("  quarters that meet at a corner are two patches",
         make_pattern(expression("x * y > 0"), coin(20)).report().patches == 2);
  report("  four patches",
         make_pattern(expression("abs(x) > 0.2 * R && abs(y) > 0.2 * R",
                                 BondingResolution::quadrature_point),
                      coin(20))
             .report()
             .patches == 4);
}



// Written by a few lines of Python with its zlib.
const std::vector<std::pair<std::string, std::string>> colour_pngs{
  {"alpha",
   "89504e470d0a1a0a0000000d4948445200000002000000020804000000d8bfc5af0000"
   "001249444154789c63f8ffbfe13f83c3ffff0c00206e05bc79db418d0000000049454e"
   "44ae426082"},
  {"colours",
   "89504e470d0a1a0a0000000d4948445200000002000000020802000000fdd49a730000"
   "001649444154789c63f8ffff7f4343038383830303030300352a053e74941248000000"
   "0049454e44ae426082"},
  {"colours_alpha",
   "89504e470d0a1a0a0000000d494844520000000200000002080600000072b60d240000"
   "001649444154789c63f80f040d0d0dff191c1c1c406c06006cfc0b3840731ee0000000"
   "0049454e44ae426082"},
  {"palette",
   "89504e470d0a1a0a0000000d49484452000000020000000208030000004568fd160000"
   "000c504c5445ffffff8080804040400909092e845f500000000474524e53ffffff0040"
   "2aa9f40000000e49444154789c6360606460620600001100079ea22a12000000004945"
   "4e44ae426082"},
  {"deep",
   "89504e470d0a1a0a0000000d4948445200000002000000021000000000074d8ebb0000"
   "001249444154789c63f8ffbfa181c1c1818101001939037ff908dc7b0000000049454e"
   "44ae426082"},
  {"bits",
   "89504e470d0a1a0a0000000d49484452000000020000000201000000005acd30890000"
   "000c49444154789c63686060000001840081f9fe65880000000049454e44ae426082"}};



// The same four pixels in the other kinds of PNG: white, 128/255, 64/255,
// black.
template <typename Read>
void
check_colours(const Read &read)
{
  double largest = 0.;
  for (const auto &[name, hex] : colour_pngs)
    {
      std::string bytes;
      for (std::size_t i = 0; i < hex.size(); i += 2)
        bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
      const auto    levels   = read(name + ".png", bytes);
      const double  grey[]   = {1., 128 / 255., 64 / 255., 0.};
      const double  black[]  = {1., 0., 0., 0.};
      const double *expected = name == "bits" ? black : grey;
      for (unsigned int i = 0; i < 4; ++i)
        grow(largest, std::abs(levels[i] - expected[i]));
    }
  report(
    "  PNG in grey and alpha, colours, colours and alpha, palette, 16 bits "
    "and 1 bit, deviation",
    largest,
    1e-6);
}



// A picture of two by two pixels: the mean over each quarter of the disk. With
// an even number of elements none lies in two quarters.
void
check_image(const std::string       &what,
            const BondingParameters &parameters,
            const double (&expected)[4])
{
  double largest = 0.;
  for (const BondingResolution resolution :
       {BondingResolution::element, BondingResolution::quadrature_point})
    {
      BondingParameters with_resolution = parameters;
      with_resolution.resolution        = resolution;
      const auto pattern = make_pattern(with_resolution, coin(6));
      for (const auto &part : pattern.parts())
        grow(largest,
             std::abs(part.phi_0 - expected[(part.centre[1] > 0 ? 0 : 2) +
                                            (part.centre[0] > 0 ? 1 : 0)]));
    }
  report("  " + what + ", deviation", largest, 1e-7); // levels are floats
}



// The four grey levels as PNG, 8 bits.
std::string
picture_of_four()
{
  const unsigned char png[] = {0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a,
                               0x00, 0x00, 0x00, 0x0d, 0x49, 0x48, 0x44, 0x52,
                               0x00, 0x00, 0x00, 0x02, 0x00, 0x00, 0x00, 0x02,
                               0x08, 0x00, 0x00, 0x00, 0x00, 0x57, 0xdd, 0x52,
                               0xf8, 0x00, 0x00, 0x00, 0x0e, 0x49, 0x44, 0x41,
                               0x54, 0x78, 0x9c, 0x63, 0xf8, 0xdf, 0xc0, 0xe0,
                               0xc0, 0x00, 0x00, 0x07, 0x81, 0x01, 0xc0, 0x12,
                               0x4a, 0x7b, 0xcc, 0x00, 0x00, 0x00, 0x00, 0x49,
                               0x45, 0x4e, 0x44, 0xae, 0x42, 0x60, 0x82};
  return {reinterpret_cast<const char *>(png), sizeof(png)};
}



void
check_images()
{
  std::cout << "Images: top left, top right, bottom left, bottom right"
            << std::endl;
  const auto image = [](const std::string &content) {
    return from_file(BondingPatternKind::image, "image", content);
  };
  const double      grey[4]     = {1., 128 / 255., 64 / 255., 0.};
  const double      quarters[4] = {1., 0.6, 0.2, 0.};
  const std::string fifths      = png_file(2, {255, 153, 51, 0});
  check_image("fifths", image(fifths), quarters);

  const std::string bytes = picture_of_four();
  check_image("PNG", image(bytes), grey);

  const auto read = [](const std::string &name, const std::string &content) {
    std::ofstream(name, std::ios::binary) << content;
    return read_grey_image(name, "File").levels;
  };
  check_colours(read);

  // the rim of a picture of 100 x 100 pixels in white is the rim of the disk:
  // pi/4 of the square, and nothing of it inside 0.96 R
  std::vector<unsigned int> ring;
  for (int j = 0; j < 100; ++j)
    for (int i = 0; i < 100; ++i)
      ring.push_back(std::hypot(i - 49.5, j - 49.5) > 48. ? 255 : 0);
  report("  the picture spans the square around the disk, deviation",
         std::abs(
           make_pattern(image(png_file(100, ring)), coin(20)).report().mean -
           (1. - 0.96 * 0.96)),
         5e-3);

  // pictures finer than elements: the mean of a line in ten, of noise
  std::vector<unsigned int> lines, noise;
  for (int j = 0; j < 1500; ++j)
    for (int i = 0; i < 1500; ++i)
      {
        lines.push_back(i % 10 == 0 ? 255 : 0);
        noise.push_back(random_number(0., 1.) < 0.55 ? 255 : 0);
      }
  for (const auto &[levels, expected, what] :
       {std::make_tuple(lines, 0.1, "lines"),
        std::make_tuple(noise, 0.55, "noise")})
    {
      const auto pattern = make_pattern(image(png_file(1500, levels)), coin(8));
      double     largest = 0.;
      for (const auto &part : pattern.parts())
        grow(largest, std::abs(part.phi_0 - expected));
      report(std::string("  area means of fine ") + what + ", deviation",
             largest,
             0.02);
      report("    in all", std::abs(pattern.report().mean - expected), 2e-3);
    }

  BondingParameters with_threshold = image(bytes);
  with_threshold.threshold         = 0.4;
  const double above[4]            = {1., 1., 0., 0.};
  check_image("PNG with a threshold", with_threshold, above);
  with_threshold           = image(png_file(2, {255, 51, 102, 0}));
  with_threshold.threshold = 0.2; // not above itself, though no binary number
  const double from_two[4] = {1., 0., 1., 0.};
  check_image("a level equal to the threshold", with_threshold, from_two);

  // a block takes the picture over its whole face
  BodyParameters block;
  block.size               = {{4, 2, 1}};
  block.cells              = {{2, 2, 1}};
  const auto   pattern     = make_pattern(image(fifths), block);
  const double expected[4] = {0.2, 0., 1., 0.6};
  double       largest     = 0.;
  for (unsigned int e = 0; e < 4; ++e)
    grow(largest, std::abs(pattern.parts()[e].phi_0 - expected[e]));
  report("  a block, the first row at its top, deviation", largest, 1e-7);
}



double
difference(const BondingPattern &a, const BondingPattern &b)
{
  double largest = a.parts().size() == b.parts().size() ? 0. : 1.;
  for (unsigned int i = 0; i < a.parts().size(); ++i)
    grow(largest, std::abs(a.parts()[i].phi_0 - b.parts()[i].phi_0));
  return largest;
}



// What bonding.csv says gives the pattern again.
void
check_files()
{
  std::cout << "Files" << std::endl;
  for (const BondingResolution resolution :
       {BondingResolution::element, BondingResolution::quadrature_point})
    {
      const auto pattern =
        make_pattern(expression("0.5 + 0.15 * x + 0.1 * y", resolution),
                     coin(6));
      const auto again = make_pattern(from_file(BondingPatternKind::file,
                                                "again.csv",
                                                pattern.table(),
                                                resolution),
                                      coin(6));
      report("  the table of a pattern gives it again, deviation",
             difference(pattern, again),
             1e-15);
    }

  // elements of the coarsest disk, by number in any order, and in order
  const auto by_number = make_pattern(
    from_file(BondingPatternKind::file,
              "number.csv",
              "phi_0,element\n0.9,9\n0.1,1\n0.2,2\n0.3,3\n0.4,4\n0.5,5\n"
              "0.6,6\n0.7,7\n0.8,8\n"),
    coin(3));
  const auto in_order =
    make_pattern(from_file(BondingPatternKind::file,
                           "order.csv",
                           "# in order\nphi_0\n0.1\n0.2\n0.3\n0.4\n0.5\n0.6\n"
                           "0.7\n0.8\n0.9\n"),
                 coin(3));
  report("  numbered elements and elements in order, deviation",
         difference(by_number, in_order),
         1e-15);
  report("  the fifth is in the middle",
         in_order.parts()[4].centre.norm() < 1e-12 &&
           in_order.parts()[4].phi_0 == 0.5);

  // three points in the middle element, one beside the disk, one at the right
  const auto points =
    make_pattern(from_file(BondingPatternKind::file,
                           "points.csv",
                           "x,y,phi_0\n0,0,0.3\n0.1,0,0.6\n0,0.1,0.9\n"
                           "9,9,1\n1.6,0,0.2\n"),
                 coin(3));
  double others = 0.;
  for (const unsigned int e : {1, 3, 7})
    grow(others, std::abs(points.parts()[e].phi_0 - 0.6));
  report("  an element with points takes their mean",
         std::abs(points.parts()[4].phi_0 - 0.6),
         1e-15);
  report("  the right one has a point", points.parts()[5].phi_0 == 0.2);
  // the corner towards (9, 9) is nearer to (1.6, 0) than to that point
  report("  one without takes the nearest", points.parts()[8].phi_0 == 0.2);
}



// A scene with an implant that has a mesh, and three points per element.
Scene
scene_of(const std::string &shape, const std::vector<std::string> &more = {})
{
  const bool is_cup = shape == "cup", is_on_bone = shape == "ring";
  std::vector<std::string> entries{"Implant/Shape=" + shape,
                                   "Implant/Element=quadratic",
                                   std::string("Implant/Cells=16, 2, ") +
                                     (is_cup ? "4" : "8"),
                                   std::string("Implant/Height=") +
                                     (is_cup ? "2" : "3"),
                                   "Expert/Interface/Quadrature points=3"};
  const auto add = [&entries](const std::vector<std::string> &others) {
    entries.insert(entries.end(), others.begin(), others.end());
  };
  if (is_on_bone)
    add({"Implant/Inner radius=1"});
  else
    add({is_cup ? "Bone/Shape=cavity" : "Bone/Shape=sleeve",
         "Bone/Outer radius=6",
         "Bone/Element=quadratic",
         "Bone/Cells=16, 2, 8"});
  if (shape == "screw")
    add({"Implant/Pitch=3"});
  if (shape == "taper")
    add({"Implant/Taper angle=15"});
  add(more);
  return coin_scene("subsection Implant\n"
                    "  set Radius = 2\n"
                    "end\n"
                    "subsection Chuck\n"
                    "  subsection Rotation z\n"
                    "    set Value = t\n"
                    "  end\n"
                    "end\n",
                    entries);
}



// On a side x and y are unrolled; r is the distance from the axis, and angle
// goes about it, as on a coin. Area means in closed form.
void
check_bores()
{
  for (const std::string shape : {"ring", "pin", "taper", "screw", "cup"})
    {
      std::cout << "On a " << shape << std::endl;
      const BodyParameters implant = scene_of(shape).implant;
      const auto           mean    = [&](const std::string &text) {
        return make_pattern(expression(text), implant).report().mean;
      };
      report("  a quarter by angle, deviation of the mean",
             std::abs(mean("angle > 0 && angle < 90") - 0.25),
             1e-10);
      report("  angle in degrees, deviation of the mean",
             std::abs(mean("angle / 360 + 0.5") - 0.5),
             shape == "screw" ? 1e-3 : 1e-10);
      // mean of r / R with R = 2: of a ring (2/3)(8 - 1)/(4 - 1)/2, of a cone
      // (2/3)(4 + 2 r + r^2)/(2 + r)/2, of half a sphere pi/4
      const double low = 2. - 3. * std::tan(15. * M_PI / 180.);
      if (shape != "screw")
        report("  r/R, deviation of the mean",
               std::abs(mean("r / R") -
                        (shape == "ring"  ? 7. / 9. :
                         shape == "pin"   ? 1. :
                         shape == "taper" ? (4. + 2. * low + low * low) /
                                              (2. + low) / 3. :
                                            M_PI / 4.)),
               1e-5);

      const NurbsSurface surface = make_contact_surface(implant);
      const auto points = surface_quadrature(surface, dealii::QGauss<1>(3));
      const auto by_point =
        make_pattern(expression("r / (4 * R) + (angle + 180) / 1000",
                                BondingResolution::quadrature_point),
                     implant);
      double largest = 0.;
      for (unsigned int q = 0; q < points.size(); ++q)
        {
          const auto &X = points[q].X;
          grow(largest,
               std::abs(by_point.at(q) -
                        std::hypot(X[0], X[1]) /
                          (4. * implant.characteristic_radius()) -
                        (std::atan2(X[1], X[0]) / M_PI + 1.) * 0.18));
        }
      report("  values at quadrature points, deviation", largest, 1e-13);

      for (const BondingResolution resolution :
           {BondingResolution::element, BondingResolution::quadrature_point})
        {
          const auto pattern =
            make_pattern(expression("(angle + 180) / 400", resolution),
                         implant);
          std::ofstream("again.csv") << pattern.table();
          const auto again = make_pattern(
            scene_of(shape,
                     {"Interface/Bonding/Pattern=file",
                      "Interface/Bonding/File=again.csv",
                      resolution == BondingResolution::element ?
                        "Expert/Interface/Bonding/Resolution=element" :
                        "Expert/Interface/Bonding/Resolution=quadrature point"})
              .interface.bonding,
            implant);
          report("  the table of a pattern gives it again, deviation",
                 difference(again, pattern),
                 1e-15);
        }
      const auto half =
        make_pattern(expression("0.7 * (angle > -45)"), implant);
      report("  a patch is no larger than what is bonded",
             half.report().largest_patch <=
               half.report().bonded_area * (1. + 1e-12));
      report(
        "  across the half-plane of 180 degrees it is one patch",
        make_pattern(expression("abs(angle) > 90"), implant).report().patches ==
          1);
    }
}



// Patches of a random pattern end across the half-plane of 180 degrees as often
// as elsewhere, and are as wide near the rim of a cup as at its lowest point:
// what is bonded has the highest values of a field in space.
void
check_random_in_bores()
{
  std::cout << "Random patches in bores" << std::endl;
  BondingParameters parameters;
  parameters.pattern            = BondingPatternKind::random;
  parameters.bonded_fraction    = 0.5;
  parameters.correlation_length = 1.5;
  double seam = 0., elsewhere = 0., lower = -1e9;
  for (const std::string shape : {"pin", "taper", "screw", "cup"})
    {
      const BodyParameters implant = scene_of(shape).implant;
      for (parameters.seed = 1; parameters.seed <= 20; ++parameters.seed)
        {
          const auto        pattern = make_pattern(parameters, implant);
          const RandomField field(parameters.seed, 1.5);
          double            lowest = 1e9, highest = -1e9;
          // by row and column of the side, 22.5 degrees apart
          std::map<std::pair<int, int>, double> phi_0;
          for (const auto &part : pattern.parts())
            {
              if (part.phi_0 == 1.)
                lowest = std::min(lowest, field(part.place));
              if (part.phi_0 == 0.)
                highest = std::max(highest, field(part.place));
              phi_0[{std::lround(part.centre[1] / 0.375 - 0.5),
                     std::lround(part.centre[0] / (M_PI / 4.) - 0.5)}] =
                part.phi_0;
            }
          grow(lower, highest - lowest);
          for (const auto &[place, value] : phi_0)
            {
              if (shape == "cup")
                break;
              const auto &[row, column] = place;
              const bool is_seam        = column == 7;
              (is_seam ? seam : elsewhere) +=
                std::abs(value - phi_0.at({row, is_seam ? -8 : column + 1})) /
                (is_seam ? 1. : 15.);
            }
        }
    }
  report("  no value of the field is higher than one that is bonded",
         lower < 0.);
  // patches that are cut would differ twice as often
  report(
    "  neighbours differ across the half-plane of 180 degrees as elsewhere",
    std::abs(seam / elsewhere - 1.),
    0.4);
}



// Results belong to the content of a file.
void
check_identity()
{
  const auto text_of_scene = [](const std::string &content) {
    std::ofstream("identity.csv") << content;
    return coin_scene("set Title = identity\n",
                      {"Interface/Bonding/Pattern=file",
                       "Interface/Bonding/File=identity.csv",
                       "Chuck/Rotation z/Value=t"})
      .completed_parameters;
  };
  const std::string ones  = "phi_0\n1\n1\n1\n1\n1\n1\n1\n1\n1\n";
  std::string       other = ones;
  other[6]                = '0';
  report("  the same content is the same scene",
         text_of_scene(ones) == text_of_scene(ones));
  report("  another content is another",
         text_of_scene(ones) != text_of_scene(other));
}



void
say(const BondingParameters &parameters)
{
  try
    {
      make_pattern(parameters, coin(3));
      std::cout << "  no message" << std::endl;
    }
  catch (const InputError &error)
    {
      std::cout << "  " << error.what() << std::endl;
    }
}



void
check_messages()
{
  std::cout << "Messages" << std::endl;
  say(expression("1.5 * r/R"));
  say(expression("-x"));
  say(expression("1/0"));
  say(expression("t"));
  say(expression("sin(x"));
  say(expression("0,5"));
  say(expression("r = 1"));
  report("  && without blanks",
         make_pattern(expression("x>0&&y>0||x<-9"), coin(6)).report().patches ==
           1);
  const auto image = [](const std::string &content) {
    return from_file(BondingPatternKind::image, "bad_image", content);
  };
  say(image(""));
  say(image("GIF89a"));
  say(image("\x89PNG and nothing else"));
  // every cut and every changed byte of a good PNG file
  const std::string whole = picture_of_four();
  unsigned int      read  = 0;
  for (std::size_t i = 0; i < whole.size(); ++i)
    {
      std::string changed = whole;
      changed[i] ^= 4;
      for (const std::string &content : {whole.substr(0, i), changed})
        try
          {
            make_pattern(image(content), coin(3));
            ++read;
          }
        catch (const InputError &)
          {}
    }
  report("  damaged PNG files are refused", read == 0);
  BondingParameters missing = image("");
  missing.file              = "not_there.png";
  say(missing);
  const auto file = [](const std::string &content) {
    return from_file(BondingPatternKind::file, "bad.csv", content);
  };
  say(file(""));
  say(file("phi_0\n1\n1\n"));
  say(file("phi_0\n1\n1\n1\n1\n1\n1\n1\n1\n1.1\n"));
  say(file("element,phi_0\n1,1\n2,1\n3,1\n4,1\n5,1\n6,1\n7,1\n8,1\n8,1\n"));
  say(file("element,phi_0\n1,1\n2,1\n3,1\n4,1\n5,1\n6,1\n7,1\n8,1\n10,1\n"));
  say(file("x,y\n1,1\n"));
  say(file("x,y,phi_0\n5,5,1\n9,0,1\n"));
  say(file("element,x_mm,y_mm,phi_0\n1,1,1,0\n2,0,0,0\n3,0,0,0\n4,0,0,0\n"
           "5,0,0,0\n6,0,0,0\n7,0,0,0\n8,0,0,0\n9,0,0,0\n"));
  say(file("x,y,phi_0\n1,1,high\n"));
  say(file("phi_0\n0,55\n"));
  say(file("X,Y,phi_0\n1,1,1\n"));
  say(file("x;y;phi_0\n1;1;1\n"));
  say(file("phi_0,element,phi_0\n1,1,1\n"));
  say(file("x,y,phi_0\n1,1,1.0000001\n"));
  BondingParameters directory = file("");
  directory.file              = ".";
  say(directory);
  directory.pattern = BondingPatternKind::image;
  say(directory);
  BondingParameters by_point = file("element,phi_0\n1,1\n");
  by_point.resolution        = BondingResolution::quadrature_point;
  say(by_point);
}



int
main()
{
  check_means();
  check_images();
  check_files();
  check_bores();
  check_random_in_bores();
  check_identity();
  check_messages();
}
