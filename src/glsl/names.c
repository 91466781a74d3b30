/* SPDX-License-Identifier: MIT
 *
 * What callers bring: names of uniforms, and texts. */
#include "../base/arguments.h"
#include "parameters.h"

enum { LONGEST_NAME = 64, LONGEST_TEXT = 1 << 20, DEEPEST_BRACKETS = 256 };

/* Words that some version of GLSL keeps for itself or has a function of (3.30, 4.50 with Vulkan, 3.00
 * to 3.20 es), and those of Shadertoy. */
static const char *const reserved[] = {
    " abs acos acosh active all allInvocations allInvocationsEqual any anyInvocation asin asinh "
    "asm atan atanh atomic_uint atomicAdd atomicAnd atomicCompSwap atomicCounter "
    "atomicCounterDecrement atomicCounterIncrement atomicExchange atomicMax atomicMin atomicOr "
    "atomicXor attribute barrier binding bitCount bitfieldExtract bitfieldInsert bitfieldReverse "
    "bool break buffer bvec2 bvec3 bvec4 case cast ceil centroid clamp class coherent common "
    "const continue core cos cosh cross default define defined degrees demote determinant dFdx "
    "dFdxCoarse dFdxFine dFdy dFdyCoarse dFdyFine discard distance dmat2 dmat2x2 dmat2x3 dmat2x4 "
    "dmat3 dmat3x2 dmat3x3 dmat3x4 dmat4 dmat4x2 dmat4x3 dmat4x4 do dot double dvec2 dvec3 dvec4 "
    "else EmitStreamVertex EmitVertex endif EndPrimitive EndStreamPrimitive enum equal es exp "
    "exp2 extension extern external faceforward false filter findLSB findMSB fixed flat float "
    "floatBitsToInt floatBitsToUint floor fma for fract frexp ftransform fvec2 fvec3 fvec4 "
    "fwidth fwidthCoarse fwidthFine GL_ES GL_EXT_gpu_shader5 goto greaterThan greaterThanEqual "
    "groupMemoryBarrier half highp hvec2 hvec3 hvec4 iChannel0 iChannel1 iChannel2 iChannel3 "
    "iChannelResolution iChannelTime iDate if ifdef ifndef iFrame iFrameRate iimage1D "
    "iimage1DArray iimage2D iimage2DArray iimage2DMS iimage2DMSArray iimage2DRect iimage3D "
    "iimageBuffer iimageCube iimageCubeArray image1D image1DArray image2D image2DArray image2DMS "
    "image2DMSArray image2DRect image3D imageAtomicAdd imageAtomicAnd imageAtomicCompSwap "
    "imageAtomicExchange imageAtomicMax imageAtomicMin imageAtomicOr imageAtomicXor imageBuffer "
    "imageCube imageCubeArray imageLoad imageSamples imageSize imageStore iMouse imulExtended in "
    "inline inout input int intBitsToFloat interface interpolateAtCentroid interpolateAtOffset "
    "interpolateAtSample invariant inverse inversesqrt iResolution isampler1D isampler1DArray "
    "isampler2D isampler2DArray isampler2DMS isampler2DMSArray isampler2DRect isampler3D "
    "iSampleRate isamplerBuffer isamplerCube isamplerCubeArray isinf isnan isubpassInput "
    "isubpassInputMS itexture1D itexture1DArray itexture2D itexture2DArray itexture2DMS "
    "itexture2DMSArray itexture2DRect itexture3D itextureBuffer itextureCube itextureCubeArray "
    "iTime iTimeDelta ivec2 ivec3 ivec4 layout ldexp ",
    " length lessThan lessThanEqual line local_size_x local_size_y local_size_z location log "
    "log2 long lowp main mainImage mat2 mat2x2 mat2x3 mat2x4 mat3 mat3x2 mat3x3 mat3x4 mat4 "
    "mat4x2 mat4x3 mat4x4 matrixCompMult max mediump memoryBarrier memoryBarrierAtomicCounter "
    "memoryBarrierBuffer memoryBarrierImage memoryBarrierShared min mix mod modf namespace "
    "noinline noise1 noise2 noise3 noise4 noperspective normalize not notEqual out outerProduct "
    "output packDouble2x32 packed packHalf2x16 packSnorm2x16 packSnorm4x8 packUnorm2x16 "
    "packUnorm4x8 partition patch pow precise precision public push_constant radians readonly "
    "reflect refract require resource restrict return round roundEven row_major sample sampler "
    "sampler1D sampler1DArray sampler1DArrayShadow sampler1DShadow sampler2D sampler2DArray "
    "sampler2DArrayShadow sampler2DMS sampler2DMSArray sampler2DRect sampler2DRectShadow "
    "sampler2DShadow sampler3D sampler3DRect samplerBuffer samplerCube samplerCubeArray "
    "samplerCubeArrayShadow samplerCubeShadow samplerShadow set shadow1D shadow2D shared short "
    "sign sin sinh sizeof smooth smoothstep sqrt static std430 step struct subpassInput "
    "subpassInputMS subpassLoad subroutine superp switch tan tanh template texelFetch "
    "texelFetchOffset texture texture1D texture1DArray texture1DLod texture1DProj texture2D "
    "texture2DArray texture2DLod texture2DMS texture2DMSArray texture2DProj texture2DProjLod "
    "texture2DRect texture3D textureBuffer textureCube textureCubeArray textureCubeLod "
    "textureGather textureGatherOffset textureGatherOffsets textureGrad textureGradOffset "
    "textureLod textureLodOffset textureOffset textureProj textureProjGrad textureProjGradOffset "
    "textureProjLod textureProjLodOffset textureProjOffset textureQueryLevels textureQueryLod "
    "textureSamples textureSize this transpose true trunc typedef uaddCarry uimage1D "
    "uimage1DArray uimage2D uimage2DArray uimage2DMS uimage2DMSArray uimage2DRect uimage3D "
    "uimageBuffer uimageCube uimageCubeArray uint uintBitsToFloat umulExtended uniform union "
    "unpackDouble2x32 unpackHalf2x16 unpackSnorm2x16 unpackSnorm4x8 unpackUnorm2x16 "
    "unpackUnorm4x8 unsigned usampler1D usampler1DArray usampler2D usampler2DArray usampler2DMS "
    "usampler2DMSArray usampler2DRect usampler3D usamplerBuffer usamplerCube usamplerCubeArray "
    "using usubBorrow usubpassInput usubpassInputMS utexture1D utexture1DArray utexture2D "
    "utexture2DArray utexture2DMS utexture2DMSArray utexture2DRect utexture3D utextureBuffer "
    "utextureCube utextureCubeArray uvec2 uvec3 uvec4 varying VULKAN vec2 vec3 vec4 version void "
    "volatile while writeonly "};

static int is_listed(const char *list, const char *name, size_t length) {
    for (const char *word = list + 1; *word != '\0';) {
        const size_t size = strcspn(word, " ");
        if (size == length && memcmp(word, name, length) == 0) return 1;
        word += size + 1;
    }
    return 0;
}

static int is_reserved(const char *name, size_t length) {
    return is_listed(reserved[0], name, length) || is_listed(reserved[1], name, length);
}

static int begins_with(const char *text, const char *start) {
    return strncmp(text, start, strlen(start)) == 0;
}

static int name_is_good(const char *name, const char *own) {
    size_t length = 0;
    if (strcmp(name, own) == 0) return 1;
    for (; length <= LONGEST_NAME && name[length] != '\0'; ++length) {
        const char c = name[length];
        const int letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
        const int digit = c >= '0' && c <= '9' && length > 0;
        if (!letter && !digit && c != '_') return 0;
        if (c == '_' && length > 0 && name[length - 1] == '_') return 0;
    }
    if (length == 0 || length > LONGEST_NAME) return 0;
    return !begins_with(name, "spt_") && !begins_with(name, "Spt") && !begins_with(name, "SPT") &&
           !begins_with(name, "gl_") && !begins_with(name, "GL_") && !is_reserved(name, length);
}

int spti_glsl_names_are_good(const char *const *names) {
    for (uint32_t i = 0; i < SPT_GLSL_NAMES; ++i) {
        if (!name_is_good(names[i], spt_glsl_default_name(i))) return 0;
        for (uint32_t k = 0; k < i; ++k) {
            if (strcmp(names[i], names[k]) == 0) return 0;
        }
    }
    return 1;
}

/* ---- Texts ---------------------------------------------------------------------------------- */

/* Brackets that are open, innermost last. */
typedef struct brackets {
    char open[DEEPEST_BRACKETS];
    int depth;
} brackets;

static int take_bracket(brackets *all, char c) {
    static const char opening[] = "([{", closing[] = ")]}";
    const char *const opens = strchr(opening, c), *const closes = strchr(closing, c);
    if (opens != NULL) {
        if (all->depth == DEEPEST_BRACKETS) return 0;
        all->open[all->depth++] = closing[opens - opening];
    } else if (closes != NULL) {
        if (all->depth == 0 || all->open[--all->depth] != c) return 0;
    }
    return 1;
}

/* Printable ASCII, no preprocessor and no line that goes on, and nothing left open. Whether it is
 * GLSL is for compilers to tell. */
int spti_glsl_text_is_good(const char *text) {
    brackets all = {{0}, 0};
    size_t length = 0, words = 0, block = 0; /* where its star is */
    int line_comment = 0;
    for (; text[length] != '\0'; ++length) {
        const char c = text[length], next = text[length + 1];
        if (length >= LONGEST_TEXT) return 0;
        if (c != '\n' && c != '\t' && (c < ' ' || c > '~')) return 0;
        if (c == '#' || c == '\\' || c == '"' || c == '\'') return 0;
        if (line_comment) {
            line_comment = c != '\n';
        } else if (block > 0) {
            /* Its own first star does not close it. */
            block = c == '/' && text[length - 1] == '*' && length > block + 1 ? 0 : block;
        } else if (c == '/' && next == '/') {
            line_comment = 1;
        } else if (c == '/' && next == '*') {
            block = length + 1;
        } else {
            words += c != ' ' && c != '\n' && c != '\t';
            if (!take_bracket(&all, c)) return 0;
        }
    }
    return words > 0 && all.depth == 0 && block == 0;
}
