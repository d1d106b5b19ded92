// Lists the attributes that shader stages exchange; struct Surface in surface.glsl explains them. Expands the macro
// ATTRIBUTE(type, name), which the including file defines, once for each attribute that the material needs.

ATTRIBUTE(vec4, color)
ATTRIBUTE(flat float, sampleNumber)
ATTRIBUTE(flat float, layer)
#ifdef CHOOSES_BY_ALPHA
ATTRIBUTE(flat int, facet)
#endif
#ifdef COLOR_RANGES
ATTRIBUTE(flat vec4, minColor)
ATTRIBUTE(flat vec4, maxColor)
#endif
#if defined(LIT) || defined(NORMAL_SLOT)
ATTRIBUTE(vec3, normal)
#endif
#ifdef LIT
ATTRIBUTE(vec3, toEye)
#endif
#ifdef COARSE_LEVEL
ATTRIBUTE(float, agreement)
#endif
#ifdef PLACED
ATTRIBUTE(vec3, position)
ATTRIBUTE(flat vec2, lens)
ATTRIBUTE(flat float, bandShift)
#endif
#ifdef TEXTURED
ATTRIBUTE(vec4, uv)
#endif
#ifdef BUMPED
ATTRIBUTE(vec4, tangent)
#endif
#ifdef PASSES_OWN_BLUR
ATTRIBUTE(vec2, ownBlur)
#endif
#ifdef MOTION_SLOT
ATTRIBUTE(vec3, opening)
ATTRIBUTE(vec3, closing)
#endif
