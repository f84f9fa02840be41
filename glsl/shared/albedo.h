/* Directional albedo: the share of light from one direction that a surface reflects to all sides
 * (or, by reciprocity, from all sides to one direction). It is the integral over the other
 * direction of the lobes of shared/brdf.h times its cosine, without the factors that depend on
 * colours,
 *
 *   specular   f0 A + f90 B      A = int (1 - s) D V nl,   B = int s D V nl,   s = (1 - v.h)^5
 *   diffuse    1 - f0 - (f90 - f0) C      C = int s nl / pi
 *
 * by quadrature with 1000 x 1000 directions: those of A and B are drawn from the distribution of
 * visible normals (E. Heitz, "Sampling the GGX Distribution of Visible Normals", JCGT 2018), C's by
 * the cosine. */
#ifndef LSF_SHARED_ALBEDO_H
#define LSF_SHARED_ALBEDO_H

#include "shared/shared.h"

#define LSF_ALBEDO_SIDE 16

/* Two lines for each roughness. */
/* clang-format off */
/* A at roughness j / 15 (rows) and cosine (i / 15)^2. */
LSF_SHARED_CONSTANT float lsf_albedo_front[LSF_ALBEDO_SIDE * LSF_ALBEDO_SIDE] = {
    0.0257f, 0.0257f, 0.0868f, 0.1850f, 0.3087f, 0.4452f, 0.5818f, 0.7072f,
    0.8124f, 0.8926f, 0.9471f, 0.9789f, 0.9940f, 0.9990f, 1.0000f, 1.0000f,
    0.0880f, 0.0639f, 0.0987f, 0.1903f, 0.3113f, 0.4465f, 0.5824f, 0.7074f,
    0.8125f, 0.8926f, 0.9470f, 0.9789f, 0.9939f, 0.9990f, 1.0000f, 1.0000f,
    0.2371f, 0.2166f, 0.1949f, 0.2366f, 0.3340f, 0.4577f, 0.5874f, 0.7088f,
    0.8121f, 0.8916f, 0.9459f, 0.9780f, 0.9933f, 0.9987f, 0.9999f, 1.0000f,
    0.3879f, 0.3754f, 0.3499f, 0.3470f, 0.3944f, 0.4856f, 0.5977f, 0.7099f,
    0.8087f, 0.8865f, 0.9408f, 0.9737f, 0.9900f, 0.9962f, 0.9977f, 0.9980f,
    0.5207f, 0.5127f, 0.4941f, 0.4800f, 0.4912f, 0.5394f, 0.6181f, 0.7106f,
    0.7998f, 0.8743f, 0.9288f, 0.9636f, 0.9822f, 0.9904f, 0.9932f, 0.9944f,
    0.6296f, 0.6238f, 0.6101f, 0.5959f, 0.5922f, 0.6100f, 0.6534f, 0.7163f,
    0.7870f, 0.8530f, 0.9060f, 0.9430f, 0.9653f, 0.9769f, 0.9824f, 0.9853f,
    0.7152f, 0.7101f, 0.6984f, 0.6851f, 0.6758f, 0.6775f, 0.6954f, 0.7302f,
    0.7769f, 0.8275f, 0.8739f, 0.9107f, 0.9363f, 0.9523f, 0.9618f, 0.9677f,
    0.7806f, 0.7751f, 0.7634f, 0.7496f, 0.7371f, 0.7301f, 0.7324f, 0.7462f,
    0.7708f, 0.8028f, 0.8371f, 0.8687f, 0.8945f, 0.9137f, 0.9273f, 0.9371f,
    0.8296f, 0.8232f, 0.8100f, 0.7941f, 0.7784f, 0.7654f, 0.7577f, 0.7572f,
    0.7647f, 0.7795f, 0.7993f, 0.8211f, 0.8423f, 0.8611f, 0.8768f, 0.8899f,
    0.8659f, 0.8582f, 0.8423f, 0.8232f, 0.8035f, 0.7852f, 0.7700f, 0.7593f,
    0.7541f, 0.7548f, 0.7608f, 0.7708f, 0.7834f, 0.7971f, 0.8110f, 0.8245f,
    0.8926f, 0.8833f, 0.8641f, 0.8408f, 0.8163f, 0.7923f, 0.7704f, 0.7515f,
    0.7366f, 0.7260f, 0.7200f, 0.7183f, 0.7204f, 0.7257f, 0.7334f, 0.7429f,
    0.9123f, 0.9011f, 0.8779f, 0.8497f, 0.8196f, 0.7897f, 0.7611f, 0.7349f,
    0.7116f, 0.6918f, 0.6757f, 0.6635f, 0.6550f, 0.6503f, 0.6489f, 0.6507f,
    0.9269f, 0.9135f, 0.8859f, 0.8522f, 0.8160f, 0.7796f, 0.7442f, 0.7109f,
    0.6801f, 0.6523f, 0.6277f, 0.6064f, 0.5885f, 0.5740f, 0.5629f, 0.5551f,
    0.9376f, 0.9219f, 0.8895f, 0.8499f, 0.8072f, 0.7639f, 0.7217f, 0.6814f,
    0.6436f, 0.6087f, 0.5768f, 0.5479f, 0.5221f, 0.4994f, 0.4797f, 0.4630f,
    0.9456f, 0.9275f, 0.8899f, 0.8440f, 0.7945f, 0.7443f, 0.6951f, 0.6481f,
    0.6038f, 0.5625f, 0.5244f, 0.4894f, 0.4576f, 0.4287f, 0.4027f, 0.3794f,
    0.9516f, 0.9308f, 0.8879f, 0.8354f, 0.7789f, 0.7217f, 0.6658f, 0.6123f,
    0.5620f, 0.5153f, 0.4721f, 0.4326f, 0.3964f, 0.3636f, 0.3338f, 0.3068f};

/* B. */
LSF_SHARED_CONSTANT float lsf_albedo_edge[LSF_ALBEDO_SIDE * LSF_ALBEDO_SIDE] = {
    0.9539f, 0.9448f, 0.9115f, 0.8146f, 0.6913f, 0.5548f, 0.4182f, 0.2928f,
    0.1876f, 0.1074f, 0.0529f, 0.0211f, 0.0060f, 0.0010f, 0.0000f, 0.0000f,
    0.9073f, 0.8282f, 0.8658f, 0.8024f, 0.6866f, 0.5527f, 0.4172f, 0.2925f,
    0.1875f, 0.1074f, 0.0530f, 0.0211f, 0.0061f, 0.0010f, 0.0000f, 0.0000f,
    0.7617f, 0.7359f, 0.6970f, 0.6855f, 0.6305f, 0.5269f, 0.4053f, 0.2873f,
    0.1857f, 0.1071f, 0.0532f, 0.0215f, 0.0063f, 0.0010f, 0.0001f, 0.0000f,
    0.6116f, 0.6016f, 0.5741f, 0.5437f, 0.5101f, 0.4516f, 0.3655f, 0.2687f,
    0.1783f, 0.1052f, 0.0535f, 0.0222f, 0.0068f, 0.0012f, 0.0001f, 0.0000f,
    0.4790f, 0.4732f, 0.4558f, 0.4291f, 0.3965f, 0.3552f, 0.2996f, 0.2314f,
    0.1609f, 0.0990f, 0.0525f, 0.0229f, 0.0075f, 0.0016f, 0.0002f, 0.0000f,
    0.3701f, 0.3659f, 0.3530f, 0.3323f, 0.3048f, 0.2714f, 0.2315f, 0.1847f,
    0.1345f, 0.0873f, 0.0491f, 0.0229f, 0.0083f, 0.0020f, 0.0003f, 0.0000f,
    0.2845f, 0.2811f, 0.2707f, 0.2542f, 0.2321f, 0.2054f, 0.1749f, 0.1412f,
    0.1059f, 0.0719f, 0.0429f, 0.0216f, 0.0086f, 0.0024f, 0.0004f, 0.0000f,
    0.2192f, 0.2162f, 0.2075f, 0.1939f, 0.1761f, 0.1549f, 0.1313f, 0.1061f,
    0.0807f, 0.0564f, 0.0352f, 0.0189f, 0.0083f, 0.0027f, 0.0005f, 0.0000f,
    0.1702f, 0.1675f, 0.1600f, 0.1486f, 0.1341f, 0.1171f, 0.0986f, 0.0794f,
    0.0606f, 0.0430f, 0.0277f, 0.0157f, 0.0074f, 0.0026f, 0.0006f, 0.0000f,
    0.1338f, 0.1314f, 0.1248f, 0.1150f, 0.1029f, 0.0891f, 0.0744f, 0.0596f,
    0.0454f, 0.0324f, 0.0213f, 0.0125f, 0.0062f, 0.0024f, 0.0006f, 0.0000f,
    0.1070f, 0.1047f, 0.0987f, 0.0902f, 0.0799f, 0.0685f, 0.0567f, 0.0450f,
    0.0341f, 0.0244f, 0.0161f, 0.0097f, 0.0050f, 0.0021f, 0.0006f, 0.0000f,
    0.0872f, 0.0850f, 0.0794f, 0.0719f, 0.0629f, 0.0533f, 0.0436f, 0.0343f,
    0.0258f, 0.0183f, 0.0122f, 0.0074f, 0.0039f, 0.0017f, 0.0005f, 0.0000f,
    0.0726f, 0.0704f, 0.0651f, 0.0582f, 0.0503f, 0.0421f, 0.0340f, 0.0264f,
    0.0196f, 0.0139f, 0.0092f, 0.0056f, 0.0030f, 0.0014f, 0.0004f, 0.0000f,
    0.0617f, 0.0595f, 0.0544f, 0.0480f, 0.0409f, 0.0337f, 0.0268f, 0.0205f,
    0.0151f, 0.0105f, 0.0069f, 0.0042f, 0.0023f, 0.0011f, 0.0004f, 0.0000f,
    0.0536f, 0.0513f, 0.0463f, 0.0402f, 0.0337f, 0.0273f, 0.0214f, 0.0161f,
    0.0117f, 0.0081f, 0.0053f, 0.0032f, 0.0018f, 0.0008f, 0.0003f, 0.0000f,
    0.0475f, 0.0451f, 0.0401f, 0.0342f, 0.0282f, 0.0224f, 0.0173f, 0.0128f,
    0.0091f, 0.0062f, 0.0040f, 0.0024f, 0.0013f, 0.0006f, 0.0002f, 0.0000f};

/* C at cosine (i / 15)^2. */
LSF_SHARED_CONSTANT float lsf_albedo_diffuse_loss[LSF_ALBEDO_SIDE] = {
    0.0281f, 0.0278f, 0.0268f, 0.0251f, 0.0229f, 0.0203f, 0.0174f, 0.0144f,
    0.0115f, 0.0087f, 0.0063f, 0.0042f, 0.0025f, 0.0013f, 0.0005f, 0.0001f};
/* clang-format on */

/* The specular lobe's albedo for f0 of one channel. */
LSF_SHARED_FUNCTION float lsf_specular_albedo(float f0, float f90, float cosine, float roughness)
{
    float x = sqrt(min(max(cosine, 0.0f), 1.0f)) * 15.0f,
          y = min(max(roughness, 0.0f), 1.0f) * 15.0f;
    int i = LSF_SHARED_INT(min(x, 14.0f)), j = LSF_SHARED_INT(min(y, 14.0f));
    float tx = x - LSF_SHARED_FLOAT(i), ty = y - LSF_SHARED_FLOAT(j);
    int at = j * LSF_ALBEDO_SIDE + i, above = at + LSF_ALBEDO_SIDE;
    float low = f0 * lsf_albedo_front[at] + f90 * lsf_albedo_edge[at];
    float low_next = f0 * lsf_albedo_front[at + 1] + f90 * lsf_albedo_edge[at + 1];
    float high = f0 * lsf_albedo_front[above] + f90 * lsf_albedo_edge[above];
    float high_next = f0 * lsf_albedo_front[above + 1] + f90 * lsf_albedo_edge[above + 1];
    low += (low_next - low) * tx;
    high += (high_next - high) * tx;
    return low + (high - low) * ty;
}

/* The share of a diffuse lobe of 1 that remains below a dielectric's reflection. */
LSF_SHARED_FUNCTION float lsf_diffuse_albedo(float f0, float f90, float cosine)
{
    float x = sqrt(min(max(cosine, 0.0f), 1.0f)) * 15.0f;
    int i = LSF_SHARED_INT(min(x, 14.0f));
    float low = lsf_albedo_diffuse_loss[i], high = lsf_albedo_diffuse_loss[i + 1];
    return 1.0f - f0 - (f90 - f0) * (low + (high - low) * (x - LSF_SHARED_FLOAT(i)));
}

#include "shared/shared_end.h"
#endif
