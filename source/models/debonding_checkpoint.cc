#include <debond/models/debonding_run.h>
#include <debond/output/checkpoint.h>
#include <debond/support/input_error.h>
#include <debond/support/interruption.h>
#include <debond/support/serialization.h>

#include <sstream>

// Checkpoints of class DebondingProblem.

namespace Debond
{
  namespace
  {
    /** At the end of an archive: another layout does not get there. */
    constexpr unsigned int end_of_state = 0x0deb03d;

    constexpr unsigned int archive_flags = boost::archive::no_header;
  } // namespace



  void
  DebondingProblem::save_checkpoint()
  {
    const dealii::TimerOutput::Scope t(state->timer, "checkpoints");
    std::ostringstream               bytes(std::ios::binary);
    {
      boost::archive::binary_oarchive archive(bytes, archive_flags);
      archive << *state << end_of_state;
    }
    if (state->field_output)
      state->field_output->put_on_disk();
    state->checkpoints->write({state->step, state->parameters, bytes.str()});
  }



  void
  DebondingProblem::keep_checkpoint() const
  {
    const std::string       &directory = state->directory->path();
    std::vector<std::string> damaged; // of no use to anyone
    try
      {
        const auto checkpoint = state->checkpoints->newest(damaged);
        if (checkpoint)
          throw InputError(
            directory +
            " holds the checkpoint of a run that was interrupted after step " +
            std::to_string(checkpoint->step) + ": debond --resume " +
            directory + " goes on with it, --force begins anew");
      }
    catch (const OtherProgram &error)
      {
        throw InputError(std::string(error.what()) + "; --force begins anew");
      }
  }



  void
  DebondingProblem::restore(const Checkpoint &checkpoint)
  {
    unsigned int end = 0;
    try
      {
        std::istringstream bytes(checkpoint.state, std::ios::binary);
        boost::archive::binary_iarchive archive(bytes, archive_flags);
        archive >> *state >> end;
      }
    catch (const std::exception &)
      {} // of the archive, or of sizes that are none
    if (end != end_of_state || state->rows.empty())
      throw InputError("the checkpoint in '" + state->directory->path() +
                       "' does not fit this build of the program: only the "
                       "same program can go on with the run");
    state->parameters = checkpoint.parameters;
    std::ostringstream text;
    text << "Going on after step " << state->step << ", time " << state->time
         << ", angle " << state->rows.back().angle_deg << " deg";
    state->console.headline(text.str());
    state->console.go_on_after(state->step);
  }



  void
  DebondingProblem::stop_if_interrupted()
  {
    const int signal = interrupting_signal();
    if (signal == 0)
      return;
    std::string text = "interrupted by " + signal_name(signal) +
                       " after step " + std::to_string(state->step);
    if (scene.output.resumable)
      {
        save_checkpoint();
        text += "; debond --resume '" + state->directory->path() +
                "' goes on from there";
      }
    throw Interrupted(signal, text);
  }



  bool
  DebondingProblem::checkpoint_is_due() const
  {
    const unsigned int every = scene.output.checkpoint_every;
    return scene.output.resumable && every > 0 && state->step % every == 0;
  }
} // namespace Debond
