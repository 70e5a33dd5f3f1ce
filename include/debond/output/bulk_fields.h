#ifndef debond_output_bulk_fields_h
#define debond_output_bulk_fields_h

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace Debond
{
  class Body;
  class Chuck;
  class NurbsSurface;

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

  /**
   * The fields of both bodies in the trial state, class FieldOutput says which,
   * drawn by dealii::DataOut. Of several ranks each has the cells of its own.
   */
  class BulkFields
  {
  public:
    /** @p bodies: bone, implant. Collective. */
    BulkFields(const std::array<const Body *, 2> &bodies, const Chuck &chuck);
    ~BulkFields();

    /** The text of a VTU file. */
    std::string
    vtu() const;
    /** The text of a file that joins those of several ranks, given by their
     *  names. */
    std::string
    list_of_pieces(const std::vector<std::string> &pieces) const;
    /** Zero of a rigid bone; its time is not set. */
    const BoneTension &
    tension() const
    {
      return largest_tension;
    }

  private:
    class FieldsInSpace;
    class JoinedDataOut;
    class DrawnCells;

    void
    add(const Body  &body,
        const Chuck &chuck,
        bool         has_curved_cells,
        bool         draws_modulus);

    /** The first one has the patches of all. */
    std::vector<std::unique_ptr<DrawnCells>> parts;
    BoneTension                              largest_tension;
  };

  /** Into how many pieces a cell is cut in each direction, so that there are
   *  about @p across of them on the face: the fewer cells a disk has, the more
   *  pieces it takes to look round. */
  unsigned int
  n_pieces(const NurbsSurface &surface,
           unsigned int        across,
           unsigned int        least,
           unsigned int        most);
} // namespace Debond
#endif
