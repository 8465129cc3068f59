FROM debian:12-slim AS build
WORKDIR /src
# The packages first: this layer stays cached while the sources change.
COPY server/install server/install
# With "build cache" and a volume at /root/.cache/ccache, what was compiled before is not compiled again.
ARG PURPOSES="build"
RUN server/install $PURPOSES
COPY CMakeLists.txt CMakePresets.json embed.cmake ./
COPY core core
COPY api api
COPY server server
RUN cmake --preset release -DBUILD_TESTING=OFF && cmake --build --preset release --target qdot \
    && strip build/release/qdot

FROM debian:12-slim
LABEL org.opencontainers.image.title="qdot" \
      org.opencontainers.image.description="Lagrangian mechanics as an HTTP service" \
      org.opencontainers.image.version="0.1.0" \
      org.opencontainers.image.licenses="MIT"
# SUNDIALS is linked from its static archives, so neither PETSc nor MPI comes along.
RUN apt-get update -qq \
    && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends libsleef3 libgmp10 libcpp-httplib0.11 \
    && rm -rf /var/lib/apt/lists/* /var/cache/apt/* /var/log/*
COPY --from=build /src/build/release/qdot /usr/local/bin/qdot
# Inside a container the loopback address would be out of everybody's reach.
ENV QDOT_HOST=0.0.0.0 QDOT_PORT=8080
# Nothing is written, no file and no privilege is needed: --read-only --cap-drop ALL --security-opt no-new-privileges.
USER 65532:65532
EXPOSE 8080
HEALTHCHECK --interval=10s --timeout=3s --start-period=2s CMD ["qdot", "health"]
STOPSIGNAL SIGTERM
ENTRYPOINT ["qdot"]
CMD ["serve"]
