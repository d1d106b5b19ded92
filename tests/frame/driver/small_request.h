#pragma once
// Fixture that makes requests for small images of two fish.

#include "defocus/defocus.h"
#include "frame/own_context.h"
#include "scratch_folder.h"

namespace defocus::engine {

class SceneRendererTest : public OwnContextTest {
protected:
    // Returns a request for two fish of 1,000 triangles each, with levels of detail.
    static Request smallRequest() {
        Request request;
        request.fishCount = 2;
        request.trianglesPerFish = 1'000;
        request.noCache = true;
        request.size.width = 96;
        request.size.height = 72;
        request.samples = 16;
        request.lens.fStop = 1;
        request.wave = 4;
        return request;
    }

    static Request movedRequest() {
        Request request = smallRequest();
        request.cameraPosition = Vector3{0.4, 0.2, 2.5};
        request.cameraTarget = Vector3{0, 0, -1};
        request.focus = FocusDistance{3};
        return request;
    }

    ScratchFolder folder_;
};

}  // namespace defocus::engine
