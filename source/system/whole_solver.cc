#include <debond/support/ranks.h>
#include <debond/support/runtime.h>
#include <debond/system/whole_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/la_parallel_vector.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <functional>

// The linear system where the bone is not condensed. Its unknowns are dealt out
// among the ranks; the first one also owns those of implant and chuck:
//
//   ( K + C_cc  C_ct       ) ( v )   ( b_bone )
//   ( C_tc      B_tt + C_tt) ( t ) = ( b_t    ).
//
// C couples the control points in contact only. For a product with it all ranks
// get to know these few, by one sum over the ranks, and each adds the rows that
// it owns.
//
// Condensing the bone on its face by an inner iteration would do with fewer
// outer ones, but each has to be as accurate as the result is to be: 66 cycles
// instead of 17 in the main scene. With one cycle in the place of K^-1 nothing
// is nested.
namespace Debond
{
  namespace
  {
    using Vector = dealii::LinearAlgebra::distributed::Vector<double>;



    /** The bone's unknowns that are in contact, and all that is beside it. */
    class WholeSystem
    {
    public:
      WholeSystem(const CoupledTangent &A,
                  const WholeBulk      &bone,
                  const unsigned int    n_unknowns,
                  const unsigned int    n_beside,
                  dealii::TimerOutput  *timer)
        : A(A)
        , bone(bone)
        , timer(timer)
        , n_bone(bone.n_owned())
        , n_unknowns(n_unknowns)
        , n_beside(n_beside)
        , n_own_beside(Ranks::is_first() ? n_beside : 0)
      {}

      Vector
      vector() const
      {
        const auto owned =
          dealii::Utilities::MPI::create_ascending_partitioning(
            Ranks::communicator(), n_bone + n_own_beside);
        return Vector(owned[Ranks::own()], Ranks::communicator());
      }

      /** The values at the unknowns, the same on all ranks. */
      Eigen::VectorXd
      unknowns_of(const Vector &x) const
      {
        Eigen::VectorXd result = Eigen::VectorXd::Zero(n_unknowns);
        bone.put_unknowns(x.begin(), result.data());
        if (n_own_beside > 0)
          result.tail(n_beside) = beside(x);
        Ranks::add_up(result);
        return result;
      }

      void
      vmult(Vector &y, const Vector &x) const
      {
        // C first: all ranks have the same few values and form the forces of
        // all points, which is little beside the bone; each adds those that it
        // owns.
        const Eigen::VectorXd at_unknowns = unknowns_of(x);
        Eigen::VectorXd       forces;
        {
          const TimedSection t(timer, "contact tangent");
          forces = A.interface_product(at_unknowns);
        }
        bone.multiply(x.begin(), y.begin());
        bone.add_unknowns(forces.data(), y.begin());
        if (n_own_beside > 0)
          put_beside(A.product_beside_bone(beside(x)) + forces.tail(n_beside),
                     y);
      }

      void
      precondition(Vector &y, const Vector &x) const
      {
        {
          const TimedSection t(timer, "cycles");
          // one V-cycle in the place of K^-1, and beside it the exact B_tt^-1
          bone.cycle(x.begin(), y.begin());
        }
        if (n_own_beside > 0)
          put_beside(A.solve_beside_bone(beside(x)), y);
      }

      void
      put_beside(const Eigen::VectorXd &values, Vector &y) const
      {
        std::copy(values.begin(), values.end(), y.begin() + n_bone);
      }

      Eigen::VectorXd
      bone_of(const Vector &x) const
      {
        return Eigen::Map<const Eigen::VectorXd>(x.begin(), n_bone);
      }

    private:
      Eigen::VectorXd
      beside(const Vector &x) const
      {
        return Eigen::Map<const Eigen::VectorXd>(x.begin() + n_bone,
                                                 n_own_beside);
      }

      const CoupledTangent &A;
      const WholeBulk      &bone;
      dealii::TimerOutput  *timer;
      const unsigned int    n_bone, n_unknowns, n_beside, n_own_beside;
    };
  } // namespace



  WholeSolution
  solve_whole(const CoupledTangent  &A,
              const WholeBulk       &bone,
              const Eigen::VectorXd &b,
              const Eigen::VectorXd &b_of_bone,
              const double           relative_tolerance,
              dealii::TimerOutput   *timer)
  {
    const TimedSection     t(timer, "multigrid");
    constexpr unsigned int most_cycles = 600, most_vectors = 60;
    const unsigned int     n_in_contact = bone.n_unknowns();
    const WholeSystem system(A, bone, b.size(), b.size() - n_in_contact, timer);
    Vector            right = system.vector(), x(right);
    std::copy(b_of_bone.begin(), b_of_bone.end(), right.begin());
    if (Ranks::is_first())
      system.put_beside(b.tail(b.size() - n_in_contact), right);
    // The tolerance is relative to the right-hand side, of bone and the rest
    // together. GMRES keeps at most 60 vectors and begins anew after that.
    const double  norm = right.l2_norm();
    WholeSolution result;
    if (norm != 0.) // NaN included, which does not converge
      {
        const struct
        {
          std::function<void(Vector &, const Vector &)> vmult;
        } preconditioner{
          [&](Vector &y, const Vector &v) { system.precondition(y, v); }};
        dealii::SolverControl       control(most_cycles,
                                      relative_tolerance * norm,
                                      false,
                                      false);
        dealii::SolverGMRES<Vector> gmres(
          control,
          dealii::SolverGMRES<Vector>::AdditionalData(most_vectors + 2, true));
        try
          {
            gmres.solve(system, x, right, preconditioner);
            result.converged = true;
          }
        catch (const dealii::SolverControl::NoConvergence &)
          {}
        result.cycles = control.last_step();
      }
    else
      result.converged = true;
    result.unknowns = system.unknowns_of(x);
    result.bone     = system.bone_of(x);
    return result;
  }
} // namespace Debond
