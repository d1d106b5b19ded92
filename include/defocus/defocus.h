#pragma once
// Includes the complete public interface of the library. Example:
//
//   defocus::Request request;
//   request.scene = "scene.glb";
//   request.lens.fStop = 1.4;
//   defocus::writeImage("out.exr", defocus::render(request));

#include "defocus/error.h"         // IWYU pragma: export
#include "defocus/image.h"         // IWYU pragma: export
#include "defocus/lens.h"          // IWYU pragma: export
#include "defocus/light_field.h"   // IWYU pragma: export
#include "defocus/plan.h"          // IWYU pragma: export
#include "defocus/pyramid.h"       // IWYU pragma: export
#include "defocus/renderer.h"      // IWYU pragma: export
#include "defocus/request.h"       // IWYU pragma: export
#include "defocus/scene.h"         // IWYU pragma: export
#include "defocus/scene_data.h"    // IWYU pragma: export
#include "defocus/setting_info.h"  // IWYU pragma: export
#include "defocus/settings.h"      // IWYU pragma: export
#include "defocus/version.h"       // IWYU pragma: export
