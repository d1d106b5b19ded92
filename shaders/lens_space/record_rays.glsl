// These functions return the pixel, the ray and the lens point of a record (ray hit).

uvec2 pixelOf(Record record) {
    uint inImage = record.ray % uint(imageSize.x * imageSize.y);
    return uvec2(inImage % uint(imageSize.x), inImage / uint(imageSize.x));
}

// Returns the index of the record's ray among its pixel's rays in the current batch (wave).
uint numberOf(Record record) { return record.ray / uint(imageSize.x * imageSize.y); }

// Returns the lens point (u, k·v), with the aspect ratio k, through which the record's surface is seen. `ray`: the
// record's ray.
vec2 lensPointOf(Record record, Ray ray) { return lineSamples ? record.place * ray.lensAndPixel.xy : ray.lensAndPixel.xy; }
