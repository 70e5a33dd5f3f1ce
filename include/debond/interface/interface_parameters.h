#pragma once

#include <debond/geometry/surface_geometry.h>
#include <debond/interface/bonding_parameters.h>
#include <debond/interface/interface_law.h>
#include <debond/interface/pressure_dependence.h>
#include <debond/shapes/side.h>

namespace Debond
{
  /** The subsection `Interface` of a scene. */
  struct InterfaceParameters
  {
    /** Body that carries the quadrature points. With the implant each of them
     *  stays in contact while the face slides over the bone, which is wider. */
    Side         slave               = Side::implant;
    bool         slave_is_auto       = true; ///< see take_slave()
    unsigned int quadrature_points   = 0;    ///< per direction, 0: auto
    double       normal_penalty      = 585;  ///< eps_n [MPa/mm]
    double       tangential_penalty  = 0;    ///< eps_t [MPa/mm], 0: as eps_n
    bool         opening_breaks_bond = false;
    /** Never null; made of what a scene says of it, friction_choice. */
    FrictionLawPointer      friction = modified_coulomb();
    LawChoice<FrictionLaw>  friction_choice{"Friction law", "modified coulomb"};
    LawChoice<InterfaceLaw> law_choice{"Law", "friction"};
    PressureDependence      pressure_dependence;
    BoneLayer               bone_layer;
    double friction_starts_at = -1e100; ///< frictionless before this time
    /** By how much the implant is thicker than its bore, of t [mm]. */
    std::string   interference   = "0";
    double        viscosity      = 0; ///< eta [MPa per (mm per unit of time)]
    SlipDirection slip_direction = SlipDirection::integrated;
    /** A variant of the method that is there to be compared with: mu at g_s^n.
     */
    bool              explicit_friction = false;
    BondingParameters bonding;

    /** Where a bore is crushed the points are the bone's, and dents stay there:
     *  those of an implant that turns would ride over the ripple of pressure
     *  between cells, and crush the bone to its maximum. On a block the points
     *  of the bone would miss the rim of the implant. */
    void
    take_slave(const bool is_in_bore)
    {
      if (slave_is_auto && bone_layer.crushes() && is_in_bore)
        slave = Side::bone;
    }

    bool
    has_interference() const
    {
      return interference != "0";
    }

    /** eps_t [MPa/mm], never 0. */
    double
    tangential_stiffness() const
    {
      return tangential_penalty == 0. ? normal_penalty : tangential_penalty;
    }

    /** Most points per direction and slave surface element. */
    static constexpr unsigned int most_points = 64;
    /** Gauss points that `Quadrature points' comes to, per direction and slave
     * surface element. */
    dealii::Quadrature<1>
    points_per_element(const BodyParameters &bone,
                       const BodyParameters &implant) const;
    /** With fewer there are cells of the other body without a point. */
    unsigned int
    fewest_points_per_element(const BodyParameters &bone,
                              const BodyParameters &implant) const;

    /** The law of the interface. Throws EntryError. */
    InterfaceLawPointer
    joint() const;

    /** See ContactPointLaw; makes the law. */
    bool
    is_viscous() const
    {
      return law().is_viscous();
    }

    /** Law and numbers that govern the points. */
    ContactPointLaw
    law() const;

    /** Bonding of the law: nothing if neither friction nor tension knows a
     * bond, whatever the scene says. */
    BondingParameters
    bonding_of_law() const;

    /** Refuses what makes no sense together. Throws EntryError. */
    void
    check(const BodyParameters &implant) const;

    void
    declare(EntryTable &table);
    /** The subsection `Expert`. */
    void
    declare_expert(EntryTable &table);

  private:
    void
    declare_rest(EntryTable &table);
  };
} // namespace Debond
