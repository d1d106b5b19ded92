// Selects the layer of the render target in the vertex shader. Without VERTEX_LAYER, a geometry shader selects it.
void chooseLayer(float layer) {
#ifdef VERTEX_LAYER
    gl_Layer = int(layer);
#endif
}
