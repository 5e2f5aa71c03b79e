// How all shaders round: to nearest, where the device can be asked for it.

#ifdef ROUNDS_TO_NEAREST
// GLSL has no words for SPV_KHR_float_controls: the execution modes RoundingModeRTE and SignedZeroInfNanPreserve, each
// with its capability.
#extension GL_EXT_spirv_intrinsics : require
spirv_execution_mode(extensions = ["SPV_KHR_float_controls"], capabilities = [4467], 4462, 32);
spirv_execution_mode(extensions = ["SPV_KHR_float_controls"], capabilities = [4466], 4461, 32);
#endif
