
${prefix}_status_t ${prefix}_kinematics(const ${prefix}_real_t q[${nv}],
                                        ${prefix}_kinematics_t *kinematics)
{
    ${prefix}_status_t status = ${PREFIX}_OK;
    real_t extent = RRNN_C(0.0);
    uint32_t i;
    for (i = 0U; i < ${nv}U; ++i) {
        extent += q[i] * q[i];
    }
    if (all_finite(q, ${nv}U) == 0) {
        status = ${PREFIX}_NOT_FINITE;
    } else if (!(extent <= (${PREFIX}_LARGEST * ${PREFIX}_LARGEST))) {
        status = ${PREFIX}_OUT_OF_RANGE;
    } else {
        pose(q, kinematics->position, kinematics->rotation, kinematics->jacobian);
    }
    return status;
}
