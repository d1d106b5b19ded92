#pragma once
// Chooses the runs of frames that `defocus capture --refocus` computes from lens images (one image per lens sample),
// and reports how many lens samples this avoids.

#include <string>
#include <vector>

#include "capture/capture.h"

namespace defocus::engine {

// Returns the runs of frames that are computed from lens images (one image per lens sample). Runs are chosen within the
// complete shot, so that a frame doesn't depend on --range and --shard. Throws Error if the lens images of a run don't
// fit into half of the memory.
RefocusRuns chosenRuns(const Shot& shot, const SequenceBase& base, const FilmSettings& settings);

// Returns a line with the number of lens samples that need not be rendered because of --refocus.
std::string savedText(const FilmSettings& settings, const FilmFigures& figures);

// Returns a line with the number of lens samples that --refocus would have avoided for the frames in `film`, which were
// rendered without it. Returns an empty string if it would have avoided none.
std::string possibleSaving(const Shot& shot, const SequenceBase& base, const FilmSettings& settings,
                           const std::vector<FilmFrame>& film);

}  // namespace defocus::engine
