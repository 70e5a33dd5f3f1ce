#pragma once

#include <debond/bulk/condensing_bulk.h>
#include <debond/bulk/whole_bulk.h>
#include <debond/support/accepted_state.h>
#include <debond/support/serialization.h>

#include <memory>
#include <vector>

namespace Debond
{
  /**
   * A body in its own frame, x = Q (X + v) + c: what the interface and the
   * coupled system see of it is a contact surface, and how the body resists its
   * displacement.
   *
   * The displacement v is the *trial* state; commit() and rollback() are the
   * only ways to and from the accepted one.
   *
   * This class itself is a rigid body: no unknowns, no energy, and whatever
   * acts on it passes to its supports. Deformable ones are derived from it.
   */
  class Body
  {
  public:
    Body(const BodyParameters &parameters, Side side);
    virtual ~Body() = default;

    const BulkSpace &
    mesh() const
    {
      return body_mesh;
    }
    const NurbsSurface &
    surface() const
    {
      return body_mesh.surface();
    }
    /** Stiffness; null: not at all to forces, and completely to moving, as
     *  a rigid body does. */
    const Bulk *
    bulk() const
    {
      return own_bulk.get();
    }
    /** The same of one kind; null if it is of the other. */
    const CondensingBulk *
    condensing() const
    {
      return condensing_bulk;
    }
    const WholeBulk *
    whole() const
    {
      return whole_bulk;
    }

    /** True if its strains are small, if it has any: its tangent is the same in
     *  every state, and moments balance with the lever arms of the reference
     *  configuration instead of X + v. */
    virtual bool
    has_small_strains() const
    {
      return true;
    }

    /** @name What it brings into the coupled system */
    //@{
    /** Makes the given control points (by index) contact unknowns. Does nothing
     *  if that has been done with the same ones and the body is still at rest.
     *  Throws InputError if the body's stiffness is not positive definite. */
    void
    set_contact_control_points(const std::vector<bool> &contact);
    const std::vector<bool> &
    contact_control_points() const
    {
      return is_contact;
    }
    /** Number of unknowns, those of the contact surface. */
    unsigned int
    n_unknowns() const
    {
      return unknown_dofs.size();
    }
    /** For 3 (control point) + component: the number of the unknown, or -1 if
     *  the component is fixed or its control point is not in contact. */
    const std::vector<int> &
    unknown_of() const
    {
      return unknown_numbers;
    }
    //@}

    /** @name Residual and correction */
    //@{
    /** Internal forces plus contact forces in a trial state; for a Newton
     *  correction of that state, and for what is known of it besides. */
    struct Residual : Bulk::Residual
    {
      bool            valid  = true;  ///< false if a cell is turned inside out
      double          energy = 0;     ///< strain energy [N mm]
      Eigen::VectorXd internal_force; ///< of a Neo-Hookean body
    };
    /** Of the trial state under the nodal contact forces @p contact_force
     *  (3 x control points, in the body's frame, [N]). */
    virtual Residual
    residual(const ControlNet & /*contact_force*/) const
    {
      return {};
    }
    /** The change of the displacement that moves the unknowns by @p dv, and the
     *  interior by what equilibrium asks for according to the @p residual of
     *  the trial state; an empty one: as if it were in equilibrium. */
    virtual Eigen::VectorXd
    correction(const Eigen::VectorXd & /*dv*/, const Residual &) const
    {
      return Eigen::VectorXd::Zero(v.size());
    }
    /** Adds such a change, or a part of it, to the trial state. */
    void
    correct(const Eigen::VectorXd &change)
    {
      v += change;
    }
    /** Forms the tangent at the trial state anew. Returns false if it is not
     *  positive definite; the old one is then kept. */
    bool
    refactor()
    {
      return has_small_strains() || linearise(v);
    }
    //@}

    /** @name State */
    //@{
    /** Displacements of the control points of the contact surface, body frame.
     *  Those of a linear body that are no contact unknowns follow at commit().
     */
    Eigen::Map<const ControlNet>
    contact_displacement() const;
    /** Accepts the trial state. @p surface_is_seen: whether anybody needs what
     *  lies beside the contact unknowns of a linear body; only then it is given
     *  its equilibrium shape. */
    void
    commit(double time, bool surface_is_seen);
    /** True if what lies beside the contact unknowns has been left behind by
     *  commit(), and giving it, in trial and accepted states, the equilibrium
     *  shape that belongs to them: no history is changed. */
    bool
    surface_was_left_behind() const
    {
      return surface_is_stale;
    }
    void
    complete_surface();
    void
    rollback()
    {
      v = accepted.value;
    }
    /** Forgets all states, for another run with the same body. */
    void
    return_to_rest();
    /** Starts a step from the accepted state, extrapolated linearly to @p time
     *  if @p extrapolate and two states are known. */
    void
    predict(const double time, const bool extrapolate)
    {
      v = extrapolate ? accepted.extrapolated(time) : accepted.value;
    }
    //@}

    /** @name What is reported */
    //@{
    /** Reaction of the supports on the body in its frame, by the @p residual of
     *  the trial state: force [N] and moment about @p centre [N mm]. */
    Eigen::Matrix<double, 6, 1>
    support_reaction(const Eigen::Vector3d &centre,
                     const Residual        &residual) const;
    /** Trial displacement of all nodes, tied vertices and, for a linear body,
     *  the interior included. */
    Eigen::VectorXd
    full_displacement() const
    {
      return full_displacement(v);
    }
    /** Cauchy stress at the mesh vertices, see Bulk. @p v: of all nodes. */
    std::vector<Eigen::Matrix3d>
    vertex_stress(const Eigen::VectorXd &v) const;
    /** The same at all Gauss points; none of a rigid body. */
    void
    for_each_stress(const Bulk::StressVisitor &visit) const;
    /** Error of small strains: by how much large strains and rotations would
     *  change its trial state under the same contact forces: Newton's
     *  first correction of a Neo-Hookean body, over the displacement, in the
     *  norm of S. Infinite if a cell is turned inside out. Costs about as much
     *  as an iteration of such a body. */
    virtual double
    change_at_large_strains() const
    {
      return 0.;
    }
    //@}

    /** See serialization.h. */
    template <class Archive>
    void
    serialize(Archive &archive, const unsigned int)
    {
      std::vector<bool> contact = is_contact;
      auto              state   = linearised_at;
      if constexpr (is_in_memory<Archive>)
        archive &contact &state;
      else
        {
          Eigen::VectorXd at     = *linearised_at;
          int             solver = solver_in_archive();
          archive        &solver;
          if (solver != solver_in_archive())
            refuse_archive(solver);
          archive &contact &at;
          state = std::make_shared<const Eigen::VectorXd>(std::move(at));
        }
      archive &accepted;
      archive &surface_is_stale;
      if (Archive::is_loading::value)
        restore(contact, *state);
    }

  protected:
    virtual Eigen::VectorXd
    full_displacement(const Eigen::VectorXd &state) const;
    /** Force and moment of the supports about the origin. */
    virtual Eigen::Matrix<double, 6, 1>
    reaction_about_origin(const Residual &) const
    {
      return Eigen::Matrix<double, 6, 1>::Zero(); // nobody asks a rigid body
    }
    /** Gives the bulk its tangent at @p state, whatever the trial state is.
     *  False if it is not positive definite. */
    virtual bool
    linearise(const Eigen::VectorXd &state);
    /** Rigid modes m (columns: three translations, three rotations about the
     *  origin) of the points that @p state has moved, at the supports only:
     *  forces R there have the resultants m . R. */
    Eigen::MatrixXd
    support_modes(const Eigen::VectorXd &state) const;

    BulkSpace                      body_mesh;
    const std::unique_ptr<Bulk>    own_bulk;
    const CondensingBulk *const    condensing_bulk;
    const WholeBulk *const         whole_bulk;
    Eigen::VectorXd                v; ///< trial displacement, 3 n_nodes [mm]
    AcceptedState<Eigen::VectorXd> accepted;
    std::vector<unsigned int>      unknown_dofs; ///< 3 node + component

  private:
    /** Checkpoints of another solver for the bulk have other nodes. */
    int
    solver_in_archive() const
    {
      return static_cast<int>(body_mesh.parameters().bulk_solver);
    }
    [[noreturn]] void
    refuse_archive(int solver) const;
    void
    number_unknowns(const std::vector<bool> &contact);
    /** Goes on from a checkpoint; the accepted state has been read. */
    void
    restore(const std::vector<bool> &contact, const Eigen::VectorXd &state);

    std::vector<int>  unknown_numbers;
    std::vector<bool> is_contact;
    /** Some of the contact surface's control points are no unknowns. */
    bool beside_unknowns = false;
    /** The displacement whose tangent the bulk uses; empty: none yet. Never
     *  changed, so that states to go back to can share it. */
    std::shared_ptr<const Eigen::VectorXd> linearised_at =
      std::make_shared<Eigen::VectorXd>();
    /** Control points did not follow at the last commit(). */
    bool surface_is_stale = false;
  };

  /** The body that the scene asks for. */
  std::unique_ptr<Body>
  make_body(const BodyParameters &parameters, Side side);
} // namespace Debond
