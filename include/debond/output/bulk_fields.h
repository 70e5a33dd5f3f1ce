#pragma once

#include <debond/output/drawn_patches.h>

#include <array>

namespace Debond
{
  class Body;
  class Chuck;

  /** The largest principal stress of the bone, and the vertex X of its mesh
   *  where it is; see Bulk::vertex_stress(). */
  struct BoneTension
  {
    double                MPa = 0, time = 0;
    std::array<double, 3> X_mm = {{0, 0, 0}};

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      archive &MPa &time &X_mm;
    }
  };

  /** The fields of both bodies in the trial state, class FieldOutput says
   * which. Of several ranks each has the cells of its own. */
  class BulkFields : public DrawnPatches<3>
  {
  public:
    /** @p bodies: bone, implant. Collective. */
    BulkFields(const std::array<const Body *, 2> &bodies, const Chuck &chuck);

    /** Zero of a rigid bone; its time is not set. */
    BoneTension tension;

  private:
    void
    draw(const Body &body, const Chuck &chuck, unsigned int n_of_curved_cells);

    const bool draws_modulus;
  };
} // namespace Debond
