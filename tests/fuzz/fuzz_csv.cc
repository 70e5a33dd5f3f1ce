// Fuzz target: the tables that a scene may name: reference curve, reference
// profiles and bonding pattern, each of which is read from the same bytes.

#include <debond/bulk/bulk_space.h>
#include <debond/interface/bonding_pattern.h>
#include <debond/output/profile_output.h>
#include <debond/output/torque_curve.h>

#include "fuzz_target.h"

extern "C" int
LLVMFuzzerTestOneInput(const std::uint8_t *data, const std::size_t size)
{
  const FileInMemory file(
    std::string(reinterpret_cast<const char *>(data), size));
  must_read_or_refuse([&file]() { Debond::read_reference_curve(file.name()); });
  must_read_or_refuse([&file]() { Debond::read_profiles(file.name()); });

  Debond::BodyParameters implant;
  implant.shape = Debond::BodyShape::coin;
  implant.cells = {{3, 3, 2}};
  Debond::BondingParameters bonding;
  bonding.pattern = Debond::BondingPatternKind::file;
  bonding.file    = file.name();
  for (const auto resolution : {Debond::BondingResolution::element,
                                Debond::BondingResolution::quadrature_point})
    must_read_or_refuse([&]() {
      bonding.resolution = resolution;
      Debond::BondingPattern(bonding,
                             implant,
                             Debond::make_contact_surface(implant),
                             dealii::QGauss<1>(3));
    });
  return 0;
}
