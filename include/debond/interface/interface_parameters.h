#ifndef debond_interface_interface_parameters_h
#define debond_interface_interface_parameters_h

#include <debond/bulk/side.h>
#include <debond/interface/bonding_parameters.h>
#include <debond/interface/contact_law.h>

namespace Debond
{
  /** The subsection `Interface` of a scene. */
  struct InterfaceParameters : ContactPointLaw
  {
    Side         slave               = Side::implant;
    unsigned int quadrature_points   = 5;   ///< per direction and element
    double       normal_penalty      = 585; ///< eps_n [MPa/mm]
    bool         opening_breaks_bond = false;
    double       friction_starts_at  = 0; ///< frictionless before this time
    /** A variant of the method that is there to be compared with: the direction
     *  of slip is that of the previous gap, Eq. (31) as printed. */
    bool              slip_along_previous_gap = false;
    BondingParameters bonding;

    static void
    declare(dealii::ParameterHandler &prm);
    void
    parse(dealii::ParameterHandler &prm);
  };
} // namespace Debond
#endif
