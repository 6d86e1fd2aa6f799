# Debian's Bullet in double precision. Its headers count as system headers: their warnings are not ours.
pkg_check_modules(bullet_float64 REQUIRED bullet-float64)
add_library(bullet_float64 INTERFACE)
target_include_directories(bullet_float64 SYSTEM INTERFACE ${bullet_float64_INCLUDE_DIRS})
target_compile_definitions(bullet_float64 INTERFACE BT_USE_DOUBLE_PRECISION)
target_link_libraries(bullet_float64 INTERFACE BulletDynamics-float64 BulletCollision-float64 LinearMath-float64)
set(BULLET_VERSION ${bullet_float64_VERSION})
